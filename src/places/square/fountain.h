// The fountain in the middle of the square: steps, a round basin, a pedestal with spouts, and a statue of
// bronze.
#pragma once

#include "scene/data/model.h"

namespace parvis::square {

/// Its foot is at the origin, the ground at z = 0; the statue looks along x.
scene::Model make_fountain();

/// Height of the spouts above the ground: where water is heard.
inline constexpr float spout_m = 1.9f;

}  // namespace parvis::square
