// What this room brings to the house: the node types that any scene has.
#pragma once

#include "base/house.h"

namespace parvis::script {

/// Adds include, group; camera; scenario, override.
void furnish(House& house);

}  // namespace parvis::script
