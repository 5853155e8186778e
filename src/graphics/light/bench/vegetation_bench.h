// Points and lines of grown plants against their real geometry, and what they cost.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// The keys vegetation_*: a grove of 200 oaks of a million triangles each, with controls beside them.
Status measure_vegetation(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
