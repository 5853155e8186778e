// C++ face of recorded_light.glsl.
#pragma once

#include "graphics/shading/tone_curve.h"

namespace parvis::shading {
#include "graphics/shading/recorded_light.glsl"
}  // namespace parvis::shading
