// Light at the vertices of an object that moves, or whose sky changes, as a running scene shows it.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// The keys relight_shipped_*: the crown of CrownCity jumps, is dragged and sees the sky turn from dawn to
/// noon, with the budget that ships. What its vertices show from frame to frame is compared with 4,096 rays
/// each.
Status measure_lit_object(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
