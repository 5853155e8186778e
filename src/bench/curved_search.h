// How exactly and how fast reflection points are found: Newton's method beside the paper's midpoint method,
// on maps of ellipsoids and of real bodies, and on ellipsoids themselves.
#pragma once

#include "bench/report.h"

namespace parvis::bench {

/// Real bodies come from the shared data; where it is absent, ellipsoids alone are measured, and a row says
/// so.
Status measure_search(bool is_quick, Report& report);

}  // namespace parvis::bench
