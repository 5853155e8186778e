// Bench `facades`: captured places against photographs that were held out, beside their baselines. Needs the
// shared photographs; figures of those that are absent are skipped.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds the bench.
void add_facades(Benches& benches);

}  // namespace parvis::bench
