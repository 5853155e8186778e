// Which surfaces of a city object bound a closed body, whose inside nobody sees.
#pragma once

#include <span>

#include "formats/city_models/city_assembly.h"

namespace parvis::scene {

/// True where the surfaces leave no gap and all face outward: each edge of a ring, to the millimetre, is an
/// edge of another ring the other way round, and the volume within is positive. Files that say "solid"
/// (CityJSON) need not be asked; CityGML reaches us without.
bool bound_a_solid(std::span<const CitySurface> surfaces);

}  // namespace parvis::scene
