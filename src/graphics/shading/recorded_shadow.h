// C++ face of recorded_shadow.glsl: shadows on photographed surfaces.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::shading {
#include "graphics/shading/recorded_shadow.glsl"
}  // namespace parvis::shading
