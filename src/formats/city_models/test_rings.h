// Outlines of buildings that tests share.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace parvis::scene {

inline const std::vector<glm::dvec2> rectangle{{0, 0}, {12, 0}, {12, 8}, {0, 8}};
inline const std::vector<glm::dvec2> l_shape{{0, 0}, {12, 0}, {12, 5}, {5, 5}, {5, 12}, {0, 12}};

}  // namespace parvis::scene
