// C++ face of octahedral.glsl.
#pragma once

#include "shading/glsl.h"

namespace parvis::shading {
#include "shading/octahedral.glsl"
}  // namespace parvis::shading
