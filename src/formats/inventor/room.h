// What this room brings to the house: models of Open Inventor and VRML.
#pragma once

#include "base/house.h"

namespace parvis::inventor {

/// Adds the reader of .iv and .wrl.
void furnish(House& house);

}  // namespace parvis::inventor
