// What this room brings to the house: the node `crowd` and the process that moves its people.
#pragma once

#include "base/house.h"

namespace parvis::crowd {

/// Adds the node type and the process.
void furnish(House& house);

}  // namespace parvis::crowd
