#include "graphics/shading/shadow.h"

#include <algorithm>

namespace parvis::shading {
namespace {

/// Gives the shared functions the maps that a shader has in its samplers.
struct ShadowLookup {
  const SunShadow& shadow;

  /// Compares as a sampler2DShadow with linear filtering and clamped edges compares.
  float shadow_compare(int map, vec3 uvz) const {
    const ImageF& depth = shadow.depth[std::size_t(map)];
    if (depth.empty()) return 1.0f;
    const float x = uvz.x * float(depth.width) - 0.5f, y = uvz.y * float(depth.height) - 0.5f;
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    const auto lit = [&](int dx, int dy) {
      const int px = std::clamp(x0 + dx, 0, depth.width - 1), py = std::clamp(y0 + dy, 0, depth.height - 1);
      return uvz.z <= *depth.at(px, py) ? 1.0f : 0.0f;
    };
    const float fx = x - float(x0), fy = y - float(y0);
    return mix(mix(lit(0, 0), lit(1, 0), fx), mix(lit(0, 1), lit(1, 1), fx), fy);
  }

#include "graphics/shading/shadow_filter.glsl"
};

}  // namespace

float sun_visibility(const SunShadow& shadow, vec3 position, vec3 normal, vec3 to_sun) {
  return ShadowLookup{shadow}.sun_visibility(shadow.maps, position, normal, to_sun);
}

}  // namespace parvis::shading
