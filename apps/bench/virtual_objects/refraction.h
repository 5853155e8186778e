// Solid glass on the kitchen's worktop, in the bench "curved": how near its pictures by virtual objects come
// to ray tracing beside cube maps rendered again.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

Status measure_refraction(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
