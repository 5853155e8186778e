// C++ face of box_projection.glsl.
#pragma once

#include "shading/glsl.h"

namespace parvis::probes {
using namespace parvis::shading;
#include "probes/box_projection.glsl"
}  // namespace parvis::probes
