// What this room brings to the house: the method multiple_environment_maps.
#pragma once

#include "base/house.h"

namespace parvis::environment_rays {

/// Adds them to the house's registries.
void furnish(House& house);

}  // namespace parvis::environment_rays
