// The square as somebody measures it who captures it from photographs: flat fronts, piers, roofs, ground and
// the fountain as a drum and a block, without colours.
#pragma once

#include <string>
#include <vector>

#include "scene/data/model.h"

namespace parvis::square {

/// Named surfaces, as layers of photographs want them (capture/facades): a few hundred triangles.
scene::Model make_coarse_square(std::uint64_t seed);

/// place.xp with a camera for each photograph of the square.
std::string photographs_script();

}  // namespace parvis::square
