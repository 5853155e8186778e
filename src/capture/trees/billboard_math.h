// billboard.glsl as C++.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::trees::display {
using namespace parvis::shading;
#include "capture/trees/billboard.glsl"
}  // namespace parvis::trees::display
