// The bench "curved": reflections on curved objects, found by Newton's method and by the paper's midpoint
// method.
#pragma once

#include "bench/report.h"

namespace parvis::bench {

/// Real bodies come from the shared data; where it is absent, ellipsoids alone are measured, and a row says
/// so.
Result<Report> curved_bench(bool is_quick);

}  // namespace parvis::bench
