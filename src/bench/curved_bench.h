// The bench "curved": reflections on curved objects. What it measures stands in the files curved_*.
#pragma once

#include "bench/report.h"

namespace parvis::bench {

Result<Report> curved_bench(bool is_quick);

}  // namespace parvis::bench
