// C++ face of preetham.glsl.
#pragma once

#include <glm/glm.hpp>

namespace parvis::light {

/// The sky of Preetham, Shirley and Smits 1999; unit vectors, z up. CIE XYZ, W/m2/sr weighted by the eye.
glm::vec3 preetham_radiance_xyz(glm::vec3 direction, glm::vec3 to_sun, float turbidity);

}  // namespace parvis::light
