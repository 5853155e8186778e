// Places with a fault that loads: each must be reported by a warning.
#pragma once

#include "bench/bench.h"

namespace parvis::bench {

/// faults_without_warning, and its control: warnings of the same faults in places that do not have them.
void measure_planted_faults(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
