// Bench `multiple_environment_maps`: what they cost, and their error against the ray tracer beside the
// baselines.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds the bench.
void add_multiple_environment_maps(Benches& benches);

}  // namespace parvis::bench
