// What this room brings to the house: sun, sky, air, exposure.
#pragma once

#include "base/house.h"

namespace parvis::light {

/// Adds the node types, and sun and sky as lights.
void furnish(House& house);

}  // namespace parvis::light
