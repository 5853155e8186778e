// Bench `window`: the rate of the window with its default options on a virtual display, and what its lowered
// resolution costs in likeness.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds the bench.
void add_window(Benches& benches);

}  // namespace parvis::bench
