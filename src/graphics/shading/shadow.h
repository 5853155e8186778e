// C++ face of shadow.glsl and shadow_filter.glsl: the renderer's shadow maps, copied, for the ray tracer.
#pragma once

#include <array>

#include "base/image.h"
#include "graphics/shading/glsl.h"

namespace parvis::shading {
#include "graphics/shading/shadow.glsl"

/// The depth of each map as OpenGL gives it back: row 0 is v = 0. Maps of zero size cast no shadow.
struct SunShadow {
  ShadowMaps maps{};
  std::array<ImageF, shadow_map_count> depth;
};

/// 1 where a point is in full sun, 0 in shadow; `normal` is the geometric one, on the viewer's side.
float sun_visibility(const SunShadow& shadow, glm::vec3 position, glm::vec3 normal, glm::vec3 to_sun);

}  // namespace parvis::shading
