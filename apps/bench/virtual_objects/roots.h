// Do searches find every reflection point of a vertex? On a torus and inside a concave ball, which show it
// several times.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

Status measure_roots(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
