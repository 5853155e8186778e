// Bench `vegetation`: points and lines of grown plants against their real geometry, and what they cost.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// The bench in the current OpenGL context; `light` prints its keys, too.
Status measure_vegetation(const BenchSetup& setup, Report& report);

/// Adds the bench.
void add_vegetation(Benches& benches);

}  // namespace parvis::bench
