// Real spherical harmonics up to the second order, and irradiance from them (Ramamoorthi and Hanrahan 2001).
// sky.glsl evaluates the same nine.
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace parvis::shading {

/// The nine harmonics of a unit direction, in the order of `sky_irradiance`.
inline std::array<float, 9> sh_basis(glm::vec3 d) {
  return {0.282095f,
          0.488603f * d.y,
          0.488603f * d.z,
          0.488603f * d.x,
          1.092548f * d.x * d.y,
          1.092548f * d.y * d.z,
          0.315392f * (3.0f * d.z * d.z - 1.0f),
          1.092548f * d.x * d.z,
          0.546274f * (d.x * d.x - d.y * d.y)};
}

/// The factor of the cosine lobe on each harmonic: pi, 2 pi / 3, pi / 4 by order.
inline constexpr std::array<float, 9> cosine_lobe{3.1415927f, 2.0943951f, 2.0943951f, 2.0943951f, 0.7853982f,
                                                  0.7853982f, 0.7853982f, 0.7853982f, 0.7853982f};

}  // namespace parvis::shading
