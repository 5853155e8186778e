// C++ face of realism.glsl.
#pragma once

#include "graphics/shading/surface.h"

namespace parvis::shading {
#include "graphics/shading/realism.glsl"
}  // namespace parvis::shading
