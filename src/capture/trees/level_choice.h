// The levels of detail of all captured trees in one view.
#pragma once

#include <span>
#include <vector>

#include "capture/trees/scene_tree.h"

namespace parvis::trees {

/// A tree in a view.
struct TreeInView {
  const TreeLevels* tree;
  SeenTree seen;
};

/// The level of each tree, given from front to back: the coarsest within the limits of `detail`. Where these
/// have fewer billboards together than a view affords, trees are shown within the finer limits, those in
/// front first: levels are drawn from each other, and each drawing blurs what the photographs show.
std::vector<std::size_t> levels_in_view(std::span<const TreeInView> trees, const TreeDetail& detail);

}  // namespace parvis::trees
