// Bench `multiple_environment_maps`: what they cost, and their error against the ray tracer beside the
// baselines.
#pragma once

#include "base/house.h"

namespace parvis::bench {

/// Registers the bench.
void furnish_multiple_environment_maps(House& house);

}  // namespace parvis::bench
