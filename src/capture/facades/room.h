// What this room brings to the house: captured facades.
#pragma once

#include "base/house.h"

namespace parvis::facades {

/// facade; its drawable.
void furnish(House& house);

}  // namespace parvis::facades
