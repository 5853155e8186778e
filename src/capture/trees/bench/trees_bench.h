// Bench `trees`: captures of sample trees with truth, from photographs to the display.
#pragma once

#include "base/house.h"

namespace parvis::bench {

/// Registers the bench.
void furnish_trees(House& house);

}  // namespace parvis::bench
