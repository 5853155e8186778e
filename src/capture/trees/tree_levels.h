// Levels of detail of a captured tree, from the hierarchy of its grid down to a few billboards.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "base/content_hash.h"
#include "capture/trees/billboard_tree.h"
#include "capture/trees/crown_light.h"
#include "capture/trees/leaf_detail.h"

namespace parvis::trees {

/// A tree as scenes show it. All levels are in the frame of the photographs' cameras.
struct TreeLevels {
  std::vector<BillboardTree> levels;          ///< the finest first; each is coarser by the grid's branching
  Bounds box;                                 ///< of the grid, metres
  glm::vec3 foot{0.0f};                       ///< where the trunk stands on the ground
  CrownLight crown;                           ///< of the levels
  std::shared_ptr<const scene::Model> trunk;  ///< lit by scenes; null: the cells show the trunk
  LeafDetail detail;                          ///< of what is closer than the photographs
};

/// The tree with each cell's parts drawn into one billboard, as each photograph sees them: with texels of the
/// same width, up to a number of texels per side.
BillboardTree coarser(const BillboardTree& tree);

/// All levels down to a single billboard.
TreeLevels levels_of(BillboardTree tree);

/// The width that a texel of the level covers, in the tree's frame, metres.
float texel_size_m(const BillboardTree& tree);

/// How a view shows a tree.
struct SeenTree {
  float pixels_per_metre;  ///< of the tree's own frame
  float parallax;          ///< sine of the angle between the eye and the photographs that it sees
};

/// The sine of the angle between the directions from the tree to an eye (in its frame) and to the eye's two
/// closest photographs: the root of the mean square by their weights, and over the tree, where an eye that is
/// nearer or farther than the photographs has another perspective. 0 at a photograph's place.
float parallax(const BillboardTree& tree, glm::vec3 eye);

/// Limits of a level of detail's difference from reality, in pixels.
struct DetailLimits {
  /// The width of a texel, where it is wider than those of the finest level.
  float max_texel_pixels = 1.0f;
  /// How far a billboard shows the front and the back of its cell beside their places: half a cell times the
  /// parallax.
  float max_shift_pixels = 3.0f;
  /// The width of a texel that is as wide as those of the finest level, but was drawn from them.
  float max_drawn_texel_pixels = std::numeric_limits<float>::infinity();

  /// Adds the limits.
  void hash(ContentHash& hash) const {
    for (const float limit : {max_texel_pixels, max_shift_pixels, max_drawn_texel_pixels}) hash.add(limit);
  }
};

/// The coarsest level within the limits.
std::size_t level_for(const TreeLevels& tree, const SeenTree& seen, const DetailLimits& limits);

}  // namespace parvis::trees
