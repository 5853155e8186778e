// Bench `processes`: how much sooner two processes of one thread each take a photograph and bake, than one.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds the bench.
void add_processes(Benches& benches);

}  // namespace parvis::bench
