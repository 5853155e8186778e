#include "synthesis/noise.h"

#include <cmath>
#include <limits>

namespace parvis::synthesis {
namespace {

std::uint32_t mixed(std::uint32_t h) {
  h ^= h >> 16, h *= 0x7feb352du, h ^= h >> 15, h *= 0x846ca68bu;
  return h ^ (h >> 16);
}

float unit(std::uint32_t h) { return float(h >> 8) * 0x1p-24f; }

float fade(float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); }

float lattice_value_3d(int x, int y, int z, std::uint32_t seed) {
  return unit(
      mixed(mixed(mixed(std::uint32_t(x) + seed * 0x9e3779b9u) + std::uint32_t(y)) + std::uint32_t(z)));
}

}  // namespace

float lattice_value(int x, int y, std::uint32_t seed) {
  return unit(mixed(mixed(std::uint32_t(x) + seed * 0x9e3779b9u) + std::uint32_t(y)));
}

float noise(glm::vec2 p, glm::ivec2 period, std::uint32_t seed) {
  const glm::vec2 corner = glm::floor(p);
  const int x0 = wrapped(int(corner.x), period.x), x1 = wrapped(x0 + 1, period.x);
  const int y0 = wrapped(int(corner.y), period.y), y1 = wrapped(y0 + 1, period.y);
  const float tx = fade(p.x - corner.x), ty = fade(p.y - corner.y);
  const float bottom = glm::mix(lattice_value(x0, y0, seed), lattice_value(x1, y0, seed), tx);
  const float top = glm::mix(lattice_value(x0, y1, seed), lattice_value(x1, y1, seed), tx);
  return glm::mix(bottom, top, ty);
}

float fractal_noise(glm::vec2 p, glm::ivec2 period, int octaves, std::uint32_t seed) {
  float sum = 0.0f, weights = 0.0f, weight = 1.0f;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * noise(p, period, seed + std::uint32_t(octave)), weights += weight;
    p *= 2.0f, period *= 2, weight *= 0.5f;
  }
  return sum / weights;
}

float noise(glm::vec3 p, std::uint32_t seed) {
  const glm::vec3 corner = glm::floor(p);
  const int x = int(corner.x), y = int(corner.y), z = int(corner.z);
  const float tx = fade(p.x - corner.x), ty = fade(p.y - corner.y), tz = fade(p.z - corner.z);
  const auto layer = [&](int k) {
    return glm::mix(
        glm::mix(lattice_value_3d(x, y, k, seed), lattice_value_3d(x + 1, y, k, seed), tx),
        glm::mix(lattice_value_3d(x, y + 1, k, seed), lattice_value_3d(x + 1, y + 1, k, seed), tx), ty);
  };
  return glm::mix(layer(z), layer(z + 1), tz);
}

float fractal_noise(glm::vec3 p, int octaves, std::uint32_t seed) {
  float sum = 0.0f, weights = 0.0f, weight = 1.0f;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * noise(p, seed + std::uint32_t(octave)), weights += weight;
    p = 2.02f * p + glm::vec3(17.3f), weight *= 0.5f;
  }
  return sum / weights;
}

Cell nearest_cell(glm::vec2 p, glm::ivec2 period, std::uint32_t seed) {
  const glm::ivec2 home(glm::floor(p));
  float first = std::numeric_limits<float>::max(), second = first, identity = 0.0f;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const glm::ivec2 cell = home + glm::ivec2(dx, dy);
      const int x = wrapped(cell.x, period.x), y = wrapped(cell.y, period.y);
      const glm::vec2 point =
          glm::vec2(cell) + glm::vec2(lattice_value(x, y, seed), lattice_value(x, y, seed + 1));
      const float distance = glm::length(point - p);
      if (distance < first) {
        second = first, first = distance, identity = lattice_value(x, y, seed + 2);
      } else if (distance < second) {
        second = distance;
      }
    }
  return {first, second - first, identity};
}

}  // namespace parvis::synthesis
