// C++ face of blend.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::facades {
using namespace shading;  // GLSL's own functions and types, for the included text
#include "capture/facades/blend.glsl"
}  // namespace parvis::facades
