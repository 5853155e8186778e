// Meshes of a tree: tubes around its branches, and sprays of leaves.
#pragma once

#include <cstddef>

#include "base/mesh.h"
#include "synthesis/tree_skeleton.h"

namespace parvis::synthesis {

inline constexpr int leaf_bearing_order = 2;  ///< branches of this order and later ones carry sprays

/// Adds a tube around a branch with smooth normals; the trunk flares at its foot.
void add_tube(Mesh& mesh, const Branch& branch, int sides);

/// Number and size of a tree's sprays of leaves.
struct Sprays {
  std::size_t count;
  float size_m;  ///< mean
};

/// Sprays distributed over the thin branches by their length, facing away from the middle of the crown.
Mesh foliage(const std::vector<Branch>& tree, const Sprays& sprays, glm::vec3 crown_middle, Random& random);

}  // namespace parvis::synthesis
