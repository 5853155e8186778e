// script/bench frame: what a frame of the paper's city costs without and with re-rendered reflections (table
// 1 of Meyer and Loscos 2003), whether hidden cars are culled, and how fast and how right the rest of the
// house is.
#pragma once

#include "bench/report.h"

namespace parvis::bench {

/// `is_quick`: fewer repetitions and views; every figure is measured all the same.
Result<Report> frame_bench(bool is_quick);

}  // namespace parvis::bench
