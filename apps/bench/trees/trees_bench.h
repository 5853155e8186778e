// Bench `trees`: captures of sample trees with truth, from photographs to the display.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds the bench.
void add_trees(Benches& benches);

}  // namespace parvis::bench
