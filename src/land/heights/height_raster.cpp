#include "land/heights/height_raster.h"

#include <cmath>

namespace parvis::scene {

std::optional<float> height_at(const HeightRaster& heights, glm::vec2 point) {
  const glm::vec2 place = (point - heights.origin) / heights.cell_m - 0.5f;
  const glm::ivec2 cell(glm::floor(place));
  const glm::vec2 fraction = place - glm::vec2(cell);
  float sum = 0.0f, weights = 0.0f;
  for (int i = 0; i < 4; ++i) {
    const int x = cell.x + i % 2, y = cell.y + i / 2;
    if (!heights.contains(x, y) || std::isnan(heights.at(x, y))) continue;
    const float weight = (i % 2 ? fraction.x : 1.0f - fraction.x) * (i / 2 ? fraction.y : 1.0f - fraction.y);
    sum += weight * heights.at(x, y), weights += weight;
  }
  if (!(weights > 1e-3f)) return std::nullopt;
  return sum / weights;
}

}  // namespace parvis::scene
