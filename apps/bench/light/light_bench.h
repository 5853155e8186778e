// Bench `light`: sun, sky and hours of sun, each against a ground truth, each with a control that must fail.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds the bench.
void add_light(Benches& benches);

}  // namespace parvis::bench
