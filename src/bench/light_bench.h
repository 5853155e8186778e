// script/bench light: sun, sky and hours of sun, each against a truth of its own, each with a control that
// must fail.
#pragma once

#include "bench/report.h"

namespace parvis::bench {

/// `is_quick`: fewer paths, suns and points; every figure is measured all the same.
Result<Report> light_bench(bool is_quick);

}  // namespace parvis::bench
