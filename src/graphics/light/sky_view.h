// The table of sky_view.glsl for one elevation of the sun, and its C++ side: the same lookup as in a shader.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "graphics/light/atmosphere.h"
#include "graphics/shading/glsl.h"

namespace parvis::light {
#include "graphics/light/sky_view_layout.glsl"

/// The sky over a place at sea level. Takes some 10 ms of a processor core.
class SkyView {
 public:
  static constexpr int columns = sky_view_columns, rows = sky_view_rows;

  /// `to_sun` is a unit vector, x east, y north, z up.
  SkyView(const Atmosphere& atmosphere, glm::vec3 to_sun);

  /// CIE XYZ in W/m2/sr weighted by the eye, of a unit direction; without the sun's disc.
  glm::vec3 radiance_xyz(glm::vec3 direction) const;
  glm::vec3 to_sun() const { return to_sun_; }
  /// Two layers of `rows` by `columns`, for a texture of floats.
  const std::vector<glm::vec4>& texels() const { return texels_; }

 private:
  glm::vec3 to_sun_;
  std::vector<glm::vec4> texels_;
};

}  // namespace parvis::light
