// Rays to the light of an object's vertices: their time and their error.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// The keys relight_10k_* and relight_N_rmse_percent: the crown of CrownCity where it has moved to, in the
/// light and shade of the city and of its own leaves.
Status measure_relighting(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
