// Bench `mem`: what multiple environment maps cost, and how near the truth they are, beside the usual
// methods.
#pragma once

#include "bench/report.h"

namespace parvis::bench {

/// Needs no context; takes minutes.
Result<Report> mem_bench(bool is_quick);

}  // namespace parvis::bench
