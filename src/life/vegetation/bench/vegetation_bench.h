// Bench `vegetation`: points and lines of grown plants against their real geometry, and what they cost.
#pragma once

#include "base/house.h"

namespace parvis::bench {

/// Registers the bench, whose keys `light` prints, too.
void furnish_vegetation(House& house);

}  // namespace parvis::bench
