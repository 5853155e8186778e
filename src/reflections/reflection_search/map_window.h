// C++ face of map_window.glsl.
#pragma once

#include "graphics/shading/octahedral.h"

namespace parvis::reflection_search {
using namespace shading;  // vec2, sign and the like, which shared files take for granted
#include "reflections/reflection_search/map_window.glsl"

/// The window of all directions from the origin.
inline const MapWindow all_directions{vec3(0.0f), mat3(1.0f), 1.0f, 0.0f, 1.0f, vec3(0.0f)};
}  // namespace parvis::reflection_search
