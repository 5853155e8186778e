// C++ face of view_blend.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::shading {
#include "graphics/shading/view_blend.glsl"
}  // namespace parvis::shading
