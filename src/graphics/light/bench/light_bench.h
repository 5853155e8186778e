// Bench `light`: sun, sky and hours of sun, each against a ground truth, each with a control that must fail.
#pragma once

#include "base/house.h"

namespace parvis::bench {

/// Registers the bench.
void furnish_light(House& house);

}  // namespace parvis::bench
