// What this room brings to the house: the light of all scenes, with the method of shadows that each asks for.
#pragma once

#include "base/house.h"

namespace parvis::shadows {

/// Replaces the light in render::Lights.
void furnish(House& house);

}  // namespace parvis::shadows
