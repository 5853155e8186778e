// What this room brings to the house: the reader of terrain.
#pragma once

#include "base/house.h"

namespace parvis::scene {

void furnish_terrain(House& house);

}  // namespace parvis::scene
