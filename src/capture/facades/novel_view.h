// Views of the model from anywhere, coloured by photographs: on the CPU with the shader's own mathematics
// (shading/view_blend.glsl), for measurements and as the ray-traced counterpart.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/image.h"
#include "capture/facades/prepared_photo.h"

namespace parvis::facades {

struct BlendSettings {
  int best = 2;                    ///< photographs per point
  float resolution_weight = 0.1f;  ///< see view_penalty
  float feather = 0.05f;           ///< of the picture's width
  float depth_tolerance = 0.01f;   ///< see not_hidden
  bool uses_trust = true;          ///< photographs count as far as their trust map says
  /// Points about which the photographs contradict each other more are left out: there the model has a
  /// surface where the place has none (sky between chimneys, leaves). 1: none is, as display wants it.
  float max_contradiction = 1.0f;
};

/// One photograph's opinion about a point.
struct Opinion {
  std::uint32_t photo = 0;
  float penalty = 0.0f;
  float confidence = 0.0f;  ///< 0..1: feather, not hidden, trust
  glm::vec3 colour{0.0f};
};

/// The photographs that see a point, best first. `pixel_size` is the display's pixel on a surface that faces
/// it there, world units.
std::vector<Opinion> opinions(std::span<const PreparedPhoto> photos, const BlendSettings& settings,
                              glm::dvec3 point, glm::dvec3 eye, double pixel_size);

/// The blend of the best; alpha 0 where no photograph sees the point or the best contradict each other.
glm::vec4 blended(std::span<const Opinion> sorted, int best, float max_contradiction);

/// The picture of `view`: linear RGBA, alpha 0 where there is no model or no photograph.
ImageF novel_view(const LayerModel& model, const View& view, std::span<const PreparedPhoto> photos,
                  const BlendSettings& settings);

}  // namespace parvis::facades
