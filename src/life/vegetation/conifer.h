// Skeleton of a spruce or fir: a straight trunk with whorls of branches that carry their twigs like combs.
#pragma once

#include <vector>

#include "base/random.h"
#include "synthesis/tree_skeleton.h"

namespace parvis::vegetation {

/// Grows a tree in whorls, one a year: the trunk first, children after their parents; the foot is at the
/// origin. Of the orders, trunk, branches, twigs and their own twigs: `children` of branches are those of a
/// whorl, of twigs at most so many; `first` of branches is the height of the lowest whorl over the tree's,
/// `length_share` their length there over the tree's height; angles are those at the foot.
std::vector<synthesis::Branch> grow_in_whorls(const synthesis::Species& species, Random& random);

}  // namespace parvis::vegetation
