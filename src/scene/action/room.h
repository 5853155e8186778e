// What this room brings to the house: actions and animations.
#pragma once

#include "base/house.h"

namespace parvis::action {

/// Adds their processes and the node types keys, timer, proximity; path and tour with their keyframes.
void furnish(House& house);

}  // namespace parvis::action
