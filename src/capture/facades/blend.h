// How photographs are blended (graphics/shading/view_blend.glsl), for this room's own text that is GLSL, too.
#pragma once

#include "graphics/shading/view_blend.h"

namespace parvis::facades {
using namespace shading;
}  // namespace parvis::facades
