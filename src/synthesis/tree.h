// Trees of exactly the paper's 59,100 triangles, and small ones for scenes with many: branches as tubes,
// leaves as cutout quads with translucency.
#pragma once

#include <cstdint>
#include <span>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::synthesis {

inline constexpr std::size_t tree_triangles = 59100;  // the paper, section 7

/// Species 0: a slender street tree; 1: a wide park tree. The foot is at the origin.
scene::Model make_tree(int species, std::uint64_t seed);

/// A slender tree of that height and about 10,000 triangles, for streets with many. The foot is at the
/// origin.
scene::Model make_medium_tree(float height_m, std::uint64_t seed);

/// Position and height of a small tree.
struct TreeSpot {
  glm::vec3 foot;  ///< in the model's frame
  float height_m;
};

/// Plants trees of about a thousand triangles each, all different, on the root node of a model.
void plant_small_trees(scene::Model& model, std::span<const TreeSpot> places, std::uint64_t seed);

}  // namespace parvis::synthesis
