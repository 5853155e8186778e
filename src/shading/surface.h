// C++ face of surface.glsl.
#pragma once

#include "shading/glsl.h"

namespace parvis::shading {
#include "shading/surface.glsl"
}  // namespace parvis::shading
