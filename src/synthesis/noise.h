// Periodic noise for textures and clouds: the same values on every machine, and no seam where a texture
// repeats.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace parvis::synthesis {

/// The remainder of a division, 0 to `period` - 1 for negative numbers, too.
inline int wrapped(int i, int period) {
  const int r = i % period;
  return r < 0 ? r + period : r;
}

/// A pseudo-random number in [0, 1) for a lattice point.
float lattice_value(int x, int y, std::uint32_t seed);

/// Smooth noise in 0..1 with features of size 1; repeats every `period` (both > 0).
float noise(glm::vec2 p, glm::ivec2 period, std::uint32_t seed);
/// Sum of `octaves` of noise, each with half the feature size and half the amplitude; 0..1 with mean 0.5.
float fractal_noise(glm::vec2 p, glm::ivec2 period, int octaves, std::uint32_t seed);

/// Noise in 3D, not periodic; 0..1.
float noise(glm::vec3 p, std::uint32_t seed);
/// Sum of octaves of 3D noise, not periodic; 0..1 with mean 0.5.
float fractal_noise(glm::vec3 p, int octaves, std::uint32_t seed);

/// Cellular noise: the nearest feature point, with one random point per unit cell (Worley 1996).
struct Cell {
  float distance = 0.0f;
  float border = 0.0f;    ///< distance to the second nearest point minus `distance`
  float identity = 0.0f;  ///< random in [0, 1), constant within a cell
};
/// Evaluates cellular noise at `p`; repeats every `period`.
Cell nearest_cell(glm::vec2 p, glm::ivec2 period, std::uint32_t seed);

}  // namespace parvis::synthesis
