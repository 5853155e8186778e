// What this room brings to the house: the reader of glTF.
#pragma once

#include "base/house.h"

namespace parvis::gltf {

/// Adds the reader of .glb and .gltf.
void furnish(House& house);

}  // namespace parvis::gltf
