#include "graphics/shading/bounced_light.h"

namespace parvis::shading {

BouncedCell BouncedLight::cell(vec3 position, vec3 geometric_normal) const {
  if (empty()) return {vec4(0.0f), vec3(0.0f), vec3(1.0f)};
  BouncedCell result{vec4(0.0f), vec3(0.0f), vec3(0.0f)};
  const vec3 at = bounced_coordinates(grid, position, geometric_normal);
  const vec3 p = vec3(at.x, at.y, 3.0f * at.z) * vec3(cells) - vec3(0.5f);
  const glm::ivec3 low(floor(p));
  const vec3 share = p - vec3(low);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step(corner & 1, (corner >> 1) & 1, corner >> 2);
    const glm::ivec3 at_corner = glm::clamp(low + step, glm::ivec3(0), cells - 1);
    const vec3 weights = glm::mix(vec3(1.0f) - share, share, vec3(step));
    const float weight = weights.x * weights.y * weights.z;
    const std::size_t i =
        (std::size_t(at_corner.z) * std::size_t(cells.y) + std::size_t(at_corner.y)) * std::size_t(cells.x) +
        std::size_t(at_corner.x);
    result.lobe += weight * lobes[i], result.colour += weight * colours[i];
    result.sky += weight * skies[i];
  }
  return result;
}

}  // namespace parvis::shading
