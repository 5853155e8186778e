// What this room brings to the house: the nodes terrain_plane, facades, roofs, ground and greenery.
#pragma once

#include "base/house.h"

namespace parvis::dressing {

/// Adds the node types of this room and their finish steps, which come before those of roads: carriageways
/// are laid on the ground that is made here.
void furnish(House& house);

}  // namespace parvis::dressing
