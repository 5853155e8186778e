// Light between surfaces as the renderer keeps it: the C++ face of bounced_light.glsl.
#pragma once

#include <vector>

#include "graphics/shading/glsl.h"

namespace parvis::shading {
#include "graphics/shading/bounced_light.glsl"

/// Irradiance by bounced light in the cells of a grid; x fastest, then y, then z.
struct BouncedLight {
  BouncedGrid grid{vec3(0.0f), vec3(1.0f), 0.0f, 0.0f};
  glm::ivec3 cells{0};
  std::vector<vec4> lobes;    ///< a cell: see bounced_irradiance
  std::vector<vec3> colours;  ///< a cell
  std::vector<vec3> skies;    ///< a cell: BouncedCell::sky

  /// There is none.
  bool empty() const { return lobes.empty(); }
  /// Mixed between the eight cells before a surface, as a texture unit does; without bounced light, and under
  /// the whole sky, where there are none.
  BouncedCell cell(vec3 position, vec3 geometric_normal) const;
};

}  // namespace parvis::shading
