// What the search for all vertices costs on the GPU, beside drawing them once more, and what grids save of
// it.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Needs no OpenGL context: it makes its own.
Status measure_cost(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
