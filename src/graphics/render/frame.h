// C++ face of frame.glsl.
#pragma once

#include "graphics/shading/glsl.h"

namespace parvis::render {

using glm::mat4, glm::vec4;
#include "graphics/render/frame.glsl"

}  // namespace parvis::render
