// Trees of exactly the paper's 59,100 triangles: branches as tubes, leaves as cut-out quads that light shines
// through.
#pragma once

#include <cstdint>

#include "base/result.h"
#include "scene/model.h"

namespace parvis::city {

inline constexpr std::size_t tree_triangles = 59100;  // the paper, section 7

/// Species 0: a slender street tree; 1: a wide park tree. The foot is at the origin.
scene::Model make_tree(int species, std::uint64_t seed);

}  // namespace parvis::city
