// Levels of detail of a captured tree, from the hierarchy of its grid down to a few billboards.
#pragma once

#include <vector>

#include "capture/trees/billboard_tree.h"
#include "capture/trees/crown_light.h"

namespace parvis::trees {

/// A tree as scenes show it. All levels are in the frame of the photographs' cameras.
struct TreeLevels {
  std::vector<BillboardTree> levels;  ///< the finest first; each is coarser by the grid's branching
  Bounds box;                         ///< of the grid, metres
  glm::vec3 foot{0.0f};               ///< where the trunk stands on the ground
  CrownLight crown;                   ///< of the levels
};

/// The tree with each cell's parts drawn into one billboard, as each photograph sees them: with twice the
/// texels along a side where a cell has 3 parts along an edge.
BillboardTree coarser(const BillboardTree& tree);

/// All levels down to one in which the tree has at most `max_last_cells` billboards.
TreeLevels levels_of(BillboardTree tree, std::size_t max_last_cells = 1);

/// The width that a texel of the level covers, in the tree's frame, metres.
float texel_size_m(const BillboardTree& tree);

/// The coarsest level whose texels are no wider than a pixel, where the tree's scale shows it at so many
/// pixels per metre of its own frame; `max_texel_pixels` widens that.
std::size_t level_for(const TreeLevels& tree, float pixels_per_metre, float max_texel_pixels);

}  // namespace parvis::trees
