// A person beside a car's bonnet, in the bench "curved": what virtual objects within a distance add to
// multiple environment maps.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

Status measure_bonnet(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
