// C++ face of surface.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::shading {
#include "graphics/shading/surface.glsl"
}  // namespace parvis::shading
