// What this room brings to the house: the nodes streetTrees, parkedCars and streetFurniture.
#pragma once

#include "base/house.h"

namespace parvis::kerbside {

/// Adds the node types of this room and their finish step, which comes after that of roads: things stand
/// beside lanes that are laid.
void furnish(House& house);

}  // namespace parvis::kerbside
