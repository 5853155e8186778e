// C++ face of box_projection.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::probes {
using namespace parvis::shading;
#include "reflections/probes/box_projection.glsl"
}  // namespace parvis::probes
