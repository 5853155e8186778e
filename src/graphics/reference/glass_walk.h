// Where light that is seen through a body of solid glass comes from: the ray that enters it, bent, and every
// ray that leaves it after no, one, two, ... reflections inside, each with its share of the light.
#pragma once

#include <vector>

#include "graphics/reference/ray_scene.h"
#include "graphics/reference/shading_point.h"

namespace parvis::reference {

/// A ray with the width of what its pixel sees: `width_m` at its origin, growing by `spread` a metre, or
/// shrinking toward a focus and growing behind it.
struct Cone {
  Ray ray;
  float width_m, spread;
};

/// A cone so far along itself: its width stays positive, and beyond a focus it grows.
Cone widened(Cone cone, float distance_m);

struct GlassExit {
  Cone cone;
  glm::vec3 share;  ///< of the light along the cone that reaches the point of entry
};

/// `seen` enters at `entry`, a point of a part that refracts, seen from outside; it is as wide as there. What
/// stands in the glass ends the ray: its cone begins before it. A body with a hole has no other side there:
/// the ray goes straight on. The shares add up to less than 1; what they lack is absorbed, or still goes
/// round after `max_inner_bounces`.
std::vector<GlassExit> glass_exits(const RayScene& rays, const Hit& hit, const ShadingPoint& entry,
                                   const Cone& seen);

}  // namespace parvis::reference
