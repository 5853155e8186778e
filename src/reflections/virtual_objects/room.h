// What this room brings to the house: the method virtual_objects, and the overlay for what stands near
// mirrors.
#pragma once

#include "base/house.h"

namespace parvis::virtual_objects {

/// Adds them to the house's registries.
void furnish(House& house);

}  // namespace parvis::virtual_objects
