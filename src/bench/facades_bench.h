// script/bench facades: captured places against photographs that were held out, beside their baselines.
#pragma once

#include "bench/report.h"

namespace parvis::bench {

/// Needs the shared photographs; figures of those that are absent are skipped. `is_quick`: fewer views.
Result<Report> facades_bench(bool is_quick);

}  // namespace parvis::bench
