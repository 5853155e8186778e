// Virtual grids, in the bench "curved": their pictures and their flicker beside the search for every vertex.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

Status measure_grids(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
