// Periodic noise for textures and clouds: the same values on every machine, and no seam where a texture
// repeats.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace parvis::city {

/// A random number in [0, 1) that belongs to a lattice point.
float lattice_value(int x, int y, std::uint32_t seed);

/// Smooth noise in 0..1 with features of size 1; repeats every `period` (both > 0).
float noise(glm::vec2 p, glm::ivec2 period, std::uint32_t seed);
/// Sum of `octaves` of noise, each half as large and half as strong; 0..1 with mean 0.5.
float fractal_noise(glm::vec2 p, glm::ivec2 period, int octaves, std::uint32_t seed);

/// The same in space, without a period.
float noise(glm::vec3 p, std::uint32_t seed);
float fractal_noise(glm::vec3 p, int octaves, std::uint32_t seed);

/// The nearest of the points scattered one in each unit cell (Worley 1996).
struct Cell {
  float distance = 0.0f;
  float border = 0.0f;    ///< difference to the distance of the second nearest
  float identity = 0.0f;  ///< random in [0, 1), the cell's own
};
Cell nearest_cell(glm::vec2 p, glm::ivec2 period, std::uint32_t seed);

}  // namespace parvis::city
