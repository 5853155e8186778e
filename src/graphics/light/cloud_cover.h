// Clouds of a photographed sky under another light: where the photograph shows cloud, and how bright that
// cloud is at an hour.
#pragma once

#include <glm/glm.hpp>

#include "base/image.h"
#include "graphics/light/sky_model.h"

namespace parvis::light {

/// How much of a pixel of a photographed sky is cloud, 0 to 1: clear sky is blue, cloud grey.
float cloud_share(glm::vec3 photographed);

/// The light on clouds two kilometres up, which are in the sun a while longer than the ground, and on the
/// land below.
class CloudLight {
 public:
  /// `dome` is equirectangular with 3 channels, turned clockwise by `heading` radians; it must outlive this.
  CloudLight(const SkyModel& sky, const Air& air, const ImageF& dome, float heading);

  /// `clear` (linear Rec. 709) with the clouds of the dome before it; below the horizon the dome's land, lit
  /// as now.
  glm::vec3 with_dome(glm::vec3 clear, glm::vec3 direction) const;

 private:
  const ImageF& dome_;
  float heading_;
  float mean_cloud_, mean_land_;  ///< luminance of the photograph's: it has no absolute scale
  glm::vec3 to_sun_;
  glm::vec3 sun_, sky_, ground_;  ///< irradiance: of clouds by sun and sky, of land by both; linear Rec. 709
};

}  // namespace parvis::light
