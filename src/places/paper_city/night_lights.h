// The paper's city by night: lit windows and shops, street lamps, headlights.
#pragma once

#include <cstdint>
#include <string>

#include "scene/data/model.h"

namespace parvis::city {

/// The windows and shop fronts that are lit, each a rectangle before its bay or module, with the glass of the
/// walls' own textures. In the frame of the city.
scene::Model make_lit_windows(std::uint64_t seed);

/// A post with a lantern, its foot at the origin.
scene::Model make_street_lamp();

/// The script night.xp: lamps of the streets, shops and vehicles, and the lit windows.
std::string night_script(std::uint64_t seed);

}  // namespace parvis::city
