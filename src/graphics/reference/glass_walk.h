// Ray walk through a body of solid glass: the refracted ray that enters it, and every ray that leaves it
// after zero, one, two, ... internal reflections, each with its share of the light.
#pragma once

#include <vector>

#include "graphics/reference/ray_scene.h"
#include "graphics/reference/shading_point.h"

namespace parvis::reference {

/// A ray with its pixel footprint (ray cone): `width_m` at its origin, growing by `spread` per metre; a
/// negative spread converges to a focus and diverges behind it.
struct Cone {
  Ray ray;
  float width_m, spread;
};

/// The cone at a distance along its ray: the width stays positive and grows behind a focus. The ray itself is
/// unchanged.
Cone widened(Cone cone, float distance_m);

/// A ray that leaves the glass, in the world.
struct GlassExit {
  Cone cone;
  glm::vec3 share;  ///< fraction, per channel, of the light along the cone that reaches the point of entry
};

/// The exits of a ray that enters the glass at `entry`, a point seen from outside; `seen` has the footprint's
/// width there. A ray that hits another object inside the glass ends there: its cone begins before that hit.
/// Where the body is open, the ray continues without a second refraction. The shares sum to less than 1: the
/// rest is absorbed, or still inside after `max_inner_bounces`.
std::vector<GlassExit> glass_exits(const RayScene& rays, const Hit& hit, const ShadingPoint& entry,
                                   const Cone& seen);

}  // namespace parvis::reference
