// Bench "curved", explosion maps (Ofek and Rappoport 1998): does the paper's belief hold that they cost as
// much as its search and are less exact?
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// newton_over_explosion_map_p99_angle, newton_over_explosion_map_time.
Status measure_explosion_maps(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
