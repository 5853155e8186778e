// Bench `curved_reflectors`: reflections on curved objects. Each measure has a file of its own.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds the bench.
void add_curved_reflectors(Benches& benches);

}  // namespace parvis::bench
