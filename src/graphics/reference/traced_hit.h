// Hits on what rooms draw by themselves, as their surfaces are asked about them.
#pragma once

#include "graphics/reference/ray_scene.h"

namespace parvis::reference {

/// A point of a triangle by the `barycentric` weights of its second and third corner. `to_viewer` is a unit
/// vector in the world; the ray sees `width_m` of the surface.
scene::TracedHit traced_hit(const PlacedPart& place, std::uint32_t triangle, glm::vec2 barycentric,
                            glm::vec3 to_viewer, float width_m);

}  // namespace parvis::reference
