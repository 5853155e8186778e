// What this room brings to the house: the reader of terrain.
#pragma once

#include "base/house.h"

namespace parvis::terrain {

/// Adds the reader of height grids in TIFF.
void furnish(House& house);

}  // namespace parvis::terrain
