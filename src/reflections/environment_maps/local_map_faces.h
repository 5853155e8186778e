// C++ face of local_map_faces.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::environment_maps {
using namespace shading;  // vec2, abs and the like, which shared files take for granted
#include "reflections/environment_maps/local_map_faces.glsl"
}  // namespace parvis::environment_maps
