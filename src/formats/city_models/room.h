// What this room brings to the house: the readers of city models.
#pragma once

#include "base/house.h"

namespace parvis::city_models {

/// Adds the readers of CityJSON, CityGML and OpenStreetMap.
void furnish(House& house);

}  // namespace parvis::city_models
