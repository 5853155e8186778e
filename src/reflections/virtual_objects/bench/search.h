// How exactly and how fast reflection points are found: Newton's method beside the paper's midpoint method,
// on maps of ellipsoids and of real bodies, and on ellipsoids themselves.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Real bodies come from the shared data; where it is absent, ellipsoids alone are measured, and a row says
/// so.
Status measure_search(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
