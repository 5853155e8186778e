// C++ face of lobe_levels.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::methods {
using namespace parvis::shading;
#include "reflections/methods/lobe_levels.glsl"
}  // namespace parvis::methods
