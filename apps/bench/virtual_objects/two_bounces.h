// What mirrors show in mirrors: pictures beside those of re-rendered cube maps, against the ray tracer.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

Status measure_two_bounces(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
