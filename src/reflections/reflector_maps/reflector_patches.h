// A reflector cut into convex and concave patches by the sign of its curvature (section 6.2 of the paper,
// which does it by hand), each of which a centre sees whole: that is what a map of directions can hold.
#pragma once

#include <vector>

#include "reflections/reflector_maps/reflector_mesh.h"

namespace parvis::reflector_maps {

struct ReflectorPatch {
  std::vector<std::uint32_t> triangles;  ///< of the mesh
  std::vector<std::uint32_t> around;     ///< of neighbouring patches, as far as the centre sees them well
  bool is_convex = true;                 ///< else the surface curves toward the side that it reflects
  bool shows_once = true;                ///< convex, and hardly anywhere a saddle: no vertex has two images
  glm::vec3 centre{0.0f};                ///< behind a convex patch, before a concave one
};

/// Every triangle is in the `triangles` of exactly one patch. Dents and bumps below a hundredth of the
/// surface go with what surrounds them.
std::vector<ReflectorPatch> reflector_patches(const ReflectorMesh& mesh);

}  // namespace parvis::reflector_maps
