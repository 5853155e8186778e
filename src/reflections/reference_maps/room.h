// What this room brings to the house: the node referenceMaps, and the method simple_blend.
#pragma once

#include "base/house.h"

namespace parvis::reference_maps {

/// Adds them to the house's registries.
void furnish(House& house);

}  // namespace parvis::reference_maps
