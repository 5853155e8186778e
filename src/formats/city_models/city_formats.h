// What this room brings to the house: the readers of city models.
#pragma once

#include "base/house.h"

namespace parvis::scene {

void furnish_city_models(House& house);

}  // namespace parvis::scene
