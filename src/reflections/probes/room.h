// What this room brings to the house: the baseline methods of reflection.
#pragma once

#include "base/house.h"

namespace parvis::probes {

/// Adds them to the house's registries.
void furnish(House& house);

}  // namespace parvis::probes
