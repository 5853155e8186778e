// C++ face of octahedral.glsl.
#pragma once

#include "shading/glsl.h"

namespace parvis::environment_maps {
using namespace shading;  // vec2, sign and the like, which shared files take for granted
#include "environment_maps/map_levels.glsl"
#include "environment_maps/octahedral.glsl"
}  // namespace parvis::environment_maps
