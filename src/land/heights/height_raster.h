// Heights of the ground as a plan raster: filled from triangles, read between its cells.
#pragma once

#include <optional>

#include "land/heights/ground_raster.h"

namespace parvis::scene {

/// Metres; NaN where no ground is known.
using HeightRaster = GroundRaster<float>;

/// Calls use(cell, height) for each cell whose centre lies in the triangle in plan. One
/// steeper than 45 degrees is no ground.
template <class Use>
void each_height(HeightRaster& heights, glm::vec3 a, glm::vec3 b, glm::vec3 c, const Use& use) {
  const glm::vec3 normal = glm::cross(b - a, c - a);
  if (!(glm::abs(normal.z) > 0.7f * glm::length(normal)) || glm::abs(normal.z) < 1e-9f) return;
  const std::vector<std::vector<glm::vec3>> rings{{a, b, c}};
  for (const glm::ivec2 cell : cells_inside(heights, rings)) {
    const glm::vec2 away = heights.centre_of(cell) - glm::vec2(a);
    use(cell, a.z - (normal.x * away.x + normal.y * away.y) / normal.z);
  }
}

/// Bilinear between the four nearest cells, as far as they are known; nothing where none is.
std::optional<float> height_at(const HeightRaster& heights, glm::vec2 point);

}  // namespace parvis::scene
