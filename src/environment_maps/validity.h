// C++ face of validity.glsl.
#pragma once

#include "shading/glsl.h"

namespace parvis::environment_maps {
using namespace shading;  // clamp, which shared files take for granted
#include "environment_maps/validity.glsl"
}  // namespace parvis::environment_maps
