// The photographs of a capture that agree with each other: one wrong camera or matte would carve the tree's
// hull and put its picture on the wrong billboards.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "capture/trees/tree_view.h"

namespace parvis::trees {

/// A sentence for each photograph whose silhouette contradicts all others (inconsistent_views), which names
/// it and says that it is left out, or, with `keeps`, that it is used all the same. Empty where all agree.
std::vector<std::string> inconsistency_notes(std::span<const TreeView> views,
                                             std::span<const std::size_t> wrong, bool keeps);

/// Erases the photographs whose silhouettes contradict all others, unless `keeps`, and returns the sentences
/// of inconsistency_notes for them.
std::vector<std::string> leave_out_inconsistent(std::vector<TreeView>& views, bool keeps);

}  // namespace parvis::trees
