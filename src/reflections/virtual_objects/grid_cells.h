// C++ face of grid_cells.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::virtual_objects {

using glm::clamp, glm::floor, glm::ivec3, glm::vec3;
#include "reflections/virtual_objects/grid_cells.glsl"

}  // namespace parvis::virtual_objects
