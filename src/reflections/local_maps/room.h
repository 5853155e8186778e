// What this room brings to the house: the method local_environment_maps.
#pragma once

#include "base/house.h"

namespace parvis::local_maps {

/// Adds them to the house's registries.
void furnish(House& house);

}  // namespace parvis::local_maps
