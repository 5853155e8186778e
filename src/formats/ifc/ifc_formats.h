// What this room brings to the house: the reader of IFC.
#pragma once

#include "base/house.h"

namespace parvis::scene {

/// Adds the reader of .ifc.
void furnish_ifc(House& house);

}  // namespace parvis::scene
