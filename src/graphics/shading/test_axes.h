// Directions that tests of this room share.
#pragma once

#include <glm/glm.hpp>

namespace parvis::shading {

inline constexpr glm::vec3 up{0.0f, 0.0f, 1.0f};

}  // namespace parvis::shading
