// C++ face of glass.glsl.
#pragma once

#include "shading/surface.h"

namespace parvis::shading {
#include "shading/glass.glsl"
}  // namespace parvis::shading
