// What this room brings to the house: models, their materials and wheels; and the reader of meshes.
#pragma once

#include "base/house.h"

namespace parvis::meshes {

/// Adds model, object, material, wheels; the reader of every file that no other room reads.
void furnish(House& house);

}  // namespace parvis::meshes
