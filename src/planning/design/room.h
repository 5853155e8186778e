// What this room brings to the house: the nodes kind, design, placed and surface.
#pragma once

#include "base/house.h"

namespace parvis::design {

/// Adds the node types of this room.
void furnish(House& house);

}  // namespace parvis::design
