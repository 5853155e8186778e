// What it costs to read files in a child process.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Measures isolated_reader_overhead_ms: reading the Hague, the p406 and a picture of 4096 x 2160 pixels in a
/// child process, less reading them in this one; the median of the three. To be run in the project's folder.
Status measure_isolation(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
