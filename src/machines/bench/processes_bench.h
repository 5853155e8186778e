// Bench `processes`: how much sooner two processes of one thread each take a photograph and bake, than one.
#pragma once

#include "base/house.h"

namespace parvis::bench {

/// Registers the bench.
void furnish_processes(House& house);

}  // namespace parvis::bench
