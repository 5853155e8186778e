// Further individuals of a captured kind. Past the thesis, whose trees are one individual each
// (003_d5b01da2d2f805f6, chapter 7, names variations as future work).
#pragma once

#include "capture/trees/billboard_tree.h"

namespace parvis::trees {

/// Another tree of the same kind: the quarters of the crown change places, some of them mirrored, height and
/// width differ by up to a tenth, the trunk stays. A cell that has moved shows what the photograph nearest to
/// the same side of it took; its light is that of its new place (tree_light.h). The same seed gives the same
/// tree.
BillboardTree new_individual(const BillboardTree& tree, std::uint64_t seed);

}  // namespace parvis::trees
