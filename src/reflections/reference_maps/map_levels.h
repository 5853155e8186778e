// C++ face of map_levels.glsl.
#pragma once

#include "graphics/shading/octahedral.h"

namespace parvis::reference_maps {
using namespace shading;  // vec2, sign and the like, which shared files take for granted
#include "reflections/reference_maps/map_levels.glsl"
}  // namespace parvis::reference_maps
