// C++ face of map_window.glsl.
#pragma once

#include "shading/octahedral.h"

namespace parvis::curved_reflectors {
using namespace shading;  // vec2, sign and the like, which shared files take for granted
#include "curved_reflectors/map_window.glsl"
}  // namespace parvis::curved_reflectors
