// What this room brings to the house: the node `traffic` and the process that drives its vehicles.
#pragma once

#include "base/house.h"

namespace parvis::traffic {

/// Adds the node type and the process.
void furnish(House& house);

}  // namespace parvis::traffic
