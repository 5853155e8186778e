// C++ face of sun.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::shading {
#include "graphics/shading/sun.glsl"
}  // namespace parvis::shading
