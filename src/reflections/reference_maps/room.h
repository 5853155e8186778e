// What this room registers: the node referenceMaps, the method simple_blend, the bake step of reference maps.
#pragma once

#include "base/house.h"

namespace parvis::reference_maps {

/// Adds them to the house's registries.
void furnish(House& house);

}  // namespace parvis::reference_maps
