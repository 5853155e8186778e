// C++ face of octahedral.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::shading {
#include "graphics/shading/octahedral.glsl"
}  // namespace parvis::shading
