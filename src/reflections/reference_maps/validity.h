// C++ face of validity.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::reference_maps {
using namespace shading;  // clamp, which shared files take for granted
#include "reflections/reference_maps/validity.glsl"
}  // namespace parvis::reference_maps
