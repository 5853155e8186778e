// C++ face of validity.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::environment_maps {
using namespace shading;  // clamp, which shared files take for granted
#include "reflections/environment_maps/validity.glsl"
}  // namespace parvis::environment_maps
