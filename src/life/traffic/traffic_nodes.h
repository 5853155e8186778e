// What this room brings to the house: the node `traffic`.
#pragma once

#include "base/house.h"

namespace parvis::traffic {

void furnish(House& house);

}  // namespace parvis::traffic
