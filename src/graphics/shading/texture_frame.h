// C++ face of texture_frame.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::shading {
#include "graphics/shading/texture_frame.glsl"
}  // namespace parvis::shading
