// How captured trees join the house: the node `tree`, and what draws and traces it.
#pragma once

#include "base/house.h"

namespace parvis::trees {

void furnish(House& house);

}  // namespace parvis::trees
