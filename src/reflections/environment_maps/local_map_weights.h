// C++ face of local_map_weights.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::environment_maps {
using namespace shading;  // vec2, clamp and the like, which shared files take for granted
#include "reflections/environment_maps/local_map_weights.glsl"
}  // namespace parvis::environment_maps
