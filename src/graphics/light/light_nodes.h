// What this room brings to the house: sun, sky, air, exposure.
#pragma once

#include "base/house.h"

namespace parvis::scene {

void furnish_light(House& house);

}  // namespace parvis::scene
