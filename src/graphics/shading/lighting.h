// C++ face of lighting.glsl.
#pragma once

#include "graphics/shading/sky.h"
#include "graphics/shading/surface.h"

namespace parvis::shading {
#include "graphics/shading/lighting.glsl"
}  // namespace parvis::shading
