// What this room brings to the house: lamps, as nodes, and their light over that of sun and sky.
#pragma once

#include "base/house.h"

namespace parvis::lamps {

/// The node lamp, the process that shows what lamps show, and lamps over the light of render::Lights. After
/// the room that chooses that light.
void furnish(House& house);

}  // namespace parvis::lamps
