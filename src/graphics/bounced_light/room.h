// What this room brings to the house: light that surfaces reflect onto each other.
#pragma once

#include "base/house.h"

namespace parvis::bounced_light {

/// The node bouncedLight, and its light over that of render::Lights. After the room that chooses that light.
void furnish(House& house);

}  // namespace parvis::bounced_light
