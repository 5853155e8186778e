// C++ face of local_map_weights.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::local_maps {
using namespace shading;  // vec2, clamp and the like, which shared files take for granted
#include "reflections/local_maps/local_map_weights.glsl"
}  // namespace parvis::local_maps
