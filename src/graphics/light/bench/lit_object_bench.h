// Light at the vertices of an object that moves, as a running scene shows it.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// The keys relight_shipped_*: a crown of 10,000 vertices in the paper's city is moved, with the budget that
/// ships, and what its vertices show from frame to frame is compared with 4,096 rays each.
Status measure_lit_object(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
