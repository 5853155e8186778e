// C++ face of glass.glsl.
#pragma once

#include "graphics/shading/surface.h"

namespace parvis::shading {
#include "graphics/shading/glass.glsl"
}  // namespace parvis::shading
