// How far straight edges, of which the ends are mirrored, are off from where each point of them is mirrored.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

Status measure_edges(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
