// Bench `curved_reflectors`: reflections on curved objects. What it measures is in the files curved_*.
#pragma once

#include "base/house.h"

namespace parvis::bench {

/// Registers the bench.
void furnish_curved_reflectors(House& house);

}  // namespace parvis::bench
