// Bench `curved_reflectors`: reflections on curved objects. Each measure has a file of its own.
#pragma once

#include "base/house.h"

namespace parvis::bench {

/// Registers the bench.
void furnish_curved_reflectors(House& house);

}  // namespace parvis::bench
