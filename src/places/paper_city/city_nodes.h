// The node types of this room: facades, roofs, ground, greenery.
#pragma once

#include "base/house.h"

namespace parvis::city {

void furnish(House& house);

}  // namespace parvis::city
