// Image-space error of reflecting only the end points of straight edges, against reflecting every point.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

Status measure_edges(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
