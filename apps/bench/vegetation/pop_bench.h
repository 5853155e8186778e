// What a viewer who comes nearer, or turns, sees of the steps between forms of plants.
#pragma once

#include "bench/vegetation/grove.h"

namespace parvis::bench {

/// The keys vegetation_pop_flip*: one tree of the grove, from afar to near; all of them around a viewer who
/// turns.
Status measure_pops(const BenchSetup& setup, Grove& grove, Report& report);

}  // namespace parvis::bench
