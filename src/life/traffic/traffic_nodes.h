// What this room brings to the house: the node `traffic` and the process that drives its vehicles.
#pragma once

#include "base/house.h"

namespace parvis::traffic {

void furnish(House& house);

}  // namespace parvis::traffic
