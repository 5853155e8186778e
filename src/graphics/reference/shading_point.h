// A hit made ready for shading: the renderer's surface shader (render/surface_body.glsl) for rays.
#pragma once

#include "graphics/reference/ray_scene.h"
#include "graphics/reference/relief.h"
#include "graphics/shading/realism.h"

namespace parvis::reference {

struct ShadingPoint {
  shading::Surface surface;    ///< of solid glass: as one that reflects alone
  glm::vec3 position;          ///< in the world
  glm::vec3 geometric_normal;  ///< interpolated over the triangle, on the viewer's side
  float curvature_per_m;       ///< how fast that normal turns, in radians a metre: spreads reflected cones
  float alpha;
  bool is_back;                 ///< seen from behind
  float openness = 1.0f;        ///< TracedPoint::openness
  float kept_in_shadow = 1.0f;  ///< TracedPoint::kept_in_shadow
  Relief relief;
};

/// Looks the material's textures up at a hit of a ray in `direction` that sees `width_m` of the surface, and
/// simplifies it (`realism`: shading::realism_at).
ShadingPoint shading_point(const Hit& hit, glm::vec3 direction, float width_m,
                           glm::vec4 realism = shading::realism_at(1.0f));

}  // namespace parvis::reference
