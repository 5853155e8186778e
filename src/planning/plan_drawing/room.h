// What this room brings to the program: the nodes planDrawing and planPicture.
#pragma once

#include "base/house.h"

namespace parvis::plan_drawing {

/// Adds the node types.
void furnish(House& house);

}  // namespace parvis::plan_drawing
