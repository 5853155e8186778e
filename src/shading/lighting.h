// C++ face of lighting.glsl.
#pragma once

#include "shading/sky.h"
#include "shading/surface.h"

namespace parvis::shading {
#include "shading/lighting.glsl"
}  // namespace parvis::shading
