// All benches of parvis_bench.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Every bench, in the order of --list; made when first asked for.
const Benches& all_benches();

}  // namespace parvis::bench
