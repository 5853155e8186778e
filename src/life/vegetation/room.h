// How grown plants join the house: the node `plant`, and what draws and traces it.
#pragma once

#include "base/house.h"

namespace parvis::vegetation {

void furnish(House& house);

}  // namespace parvis::vegetation
