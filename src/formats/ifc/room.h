// What this room brings to the house: the reader of IFC.
#pragma once

#include "base/house.h"

namespace parvis::ifc {

/// Adds the reader of .ifc.
void furnish(House& house);

}  // namespace parvis::ifc
