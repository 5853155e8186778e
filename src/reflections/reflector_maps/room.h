// What this room registers: the bake step of reflectors.
#pragma once

#include "base/house.h"

namespace parvis::reflector_maps {

/// Adds it to the house's registries.
void furnish(House& house);

}  // namespace parvis::reflector_maps
