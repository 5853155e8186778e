// What a viewer who comes nearer sees of the steps between forms of plants.
#pragma once

#include "life/vegetation/bench/grove.h"

namespace parvis::bench {

/// The keys vegetation_pop_flip*: one tree of the grove, from afar to near.
Status measure_pops(const BenchSetup& setup, Grove& grove, Report& report);

}  // namespace parvis::bench
