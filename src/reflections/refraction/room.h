// What this room brings to the house: the overlay for what solid glass lets through.
#pragma once

#include "base/house.h"

namespace parvis::refraction {

/// Adds them to the house's registries.
void furnish(House& house);

}  // namespace parvis::refraction
