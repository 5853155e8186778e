// How many pixels of a view a shadow map gets wrong, against exact rays.
//
// A map holds, for the middle of each texel, the first caster on the line toward the sun. Whether that lies
// before a point can be asked of the scene by a ray along the very line, so that no map need be drawn: what
// is judged is the method alone.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "graphics/light/shadow_fit.h"
#include "graphics/reference/ray_scene.h"

namespace parvis::light {

struct ShadowErrors {
  long pixels = 0;                                       ///< that face the sun
  std::array<long, shadow_method_names.size()> wrong{};  ///< of each method

  double percent(ShadowMethod method) const {
    return pixels > 0 ? 100.0 * double(wrong[std::size_t(method)]) / double(pixels) : 0.0;
  }
  void add(const ShadowErrors& other);
};

/// Errors in one view of `width` x `height` pixels; `resolution` is the side of the memory that each method
/// may use. Lookups are moved off the surface by as much as a texel measures there, as renderers do against
/// self-shadowing.
ShadowErrors check_shadows(const reference::RayScene& scene, const Bounds& casters, const Camera& camera,
                           int width, int height, glm::vec3 to_sun, int resolution);

}  // namespace parvis::light
