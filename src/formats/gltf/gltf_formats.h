// What this room brings to the house: the reader of glTF.
#pragma once

#include "base/house.h"

namespace parvis::scene {

void furnish_gltf(House& house);

}  // namespace parvis::scene
