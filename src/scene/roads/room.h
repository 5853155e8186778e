// What this room brings to the house: road, streets, paving.
#pragma once

#include "base/house.h"

namespace parvis::roads {

/// Adds the node types, and the step that makes lanes of roads.
void furnish(House& house);

}  // namespace parvis::roads
