// What this room brings to the house: the method traced.
#pragma once

#include "base/house.h"

namespace parvis::traced {

/// Adds it to the house's registries.
void furnish(House& house);

}  // namespace parvis::traced
