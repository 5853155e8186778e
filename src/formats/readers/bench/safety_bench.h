// script/bench doors, what must not happen: files that are no glTF, readers that fail on hostile input.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds gltf_validator_errors (Khronos's validator over every file of the paper's city) and fuzz_findings
/// (measure_fuzzers). To be run in the project's folder, whose scripts it calls.
Status measure_safety(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
