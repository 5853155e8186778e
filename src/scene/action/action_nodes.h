// What this room brings to the house: the processes of actions and animations, and the node types keys,
// timer, proximity; path and tour with their keyframes.
#pragma once

#include <string>
#include <vector>

#include "base/house.h"

namespace parvis::action {

void furnish(House& house);

/// What `keys` may name: letters, digits, named keys, mouse1.. and button1.. of a game controller.
const std::vector<std::string>& key_names();

}  // namespace parvis::action
