// script/bench doors: what enters and leaves the house. Each measure lies in a file of its own.
#pragma once

#include "bench/report.h"

namespace parvis::bench {

/// `is_quick`: fewer repetitions and samples; every figure is measured all the same.
Result<Report> doors_bench(bool is_quick);

}  // namespace parvis::bench
