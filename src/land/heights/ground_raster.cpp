#include "land/heights/ground_raster.h"

#include <algorithm>
#include <cmath>

#include "base/plan_polygon.h"

namespace parvis::scene {

namespace {

constexpr float very_far = 1e20f;

/// Lower envelope of the parabolas value[i] + (x - i)^2, evaluated at every i.
void transform_line(std::span<const float> values, std::span<float> result, std::vector<int>& roots,
                    std::vector<float>& limits) {
  const int count = int(values.size());
  int last = 0;
  roots[0] = 0, limits[0] = -very_far, limits[1] = very_far;
  const auto value = [&](int i) { return values[std::size_t(i)] + float(i) * float(i); };
  for (int i = 1; i < count; ++i) {
    const auto meeting = [&] {
      const int root = roots[std::size_t(last)];
      return (value(i) - value(root)) / (2.0f * float(i - root));
    };
    while (last > 0 && meeting() <= limits[std::size_t(last)]) --last;
    const float from = meeting();
    ++last;
    roots[std::size_t(last)] = i, limits[std::size_t(last)] = from, limits[std::size_t(last) + 1] = very_far;
  }
  int k = 0;
  for (int i = 0; i < count; ++i) {
    while (limits[std::size_t(k) + 1] < float(i)) ++k;
    const float away = float(i - roots[std::size_t(k)]);
    result[std::size_t(i)] = away * away + values[std::size_t(roots[std::size_t(k)])];
  }
}

/// Cells of `value` that hang together with (x, y), by their four sides.
std::vector<glm::ivec2> region_around(const Mask& mask, glm::ivec2 start, Mask& is_seen) {
  const unsigned char value = mask.at(start.x, start.y);
  std::vector<glm::ivec2> region{start};
  is_seen.at(start.x, start.y) = 1;
  for (std::size_t i = 0; i < region.size(); ++i)
    for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
      const glm::ivec2 next = region[i] + step;
      if (!mask.contains(next.x, next.y) || is_seen.at(next.x, next.y) || mask.at(next.x, next.y) != value)
        continue;
      is_seen.at(next.x, next.y) = 1;
      region.push_back(next);
    }
  return region;
}

}  // namespace

std::vector<glm::ivec2> cells_inside(const GroundGrid& grid, std::span<const std::vector<glm::vec3>> rings) {
  std::vector<glm::ivec2> cells;
  float low = grid.origin.y + grid.cell_m * float(grid.height), high = grid.origin.y;
  for (const std::vector<glm::vec3>& ring : rings)
    for (const glm::vec3& p : ring) low = std::min(low, p.y), high = std::max(high, p.y);
  const int first = std::max(0, grid.cell_at({0.0f, low}).y);
  const int last = std::min(grid.height - 1, grid.cell_at({0.0f, high}).y);

  for (int y = first; y <= last; ++y) {
    const std::vector<float> crossings = crossings_of_line(rings, grid.centre_of({0, y}).y);
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const int from = int(std::ceil((crossings[i] - grid.origin.x) / grid.cell_m - 0.5f));
      const int to = int(std::floor((crossings[i + 1] - grid.origin.x) / grid.cell_m - 0.5f));
      for (int x = std::max(from, 0); x <= std::min(to, grid.width - 1); ++x) cells.emplace_back(x, y);
    }
  }
  return cells;
}

GroundRaster<float> distances_to(const Mask& mask, unsigned char target) {
  GroundRaster<float> squares(mask, 0.0f);
  for (std::size_t i = 0; i < mask.cells.size(); ++i)
    squares.cells[i] = mask.cells[i] == target ? 0.0f : very_far;

  const std::size_t longest = std::size_t(std::max(mask.width, mask.height));
  std::vector<float> line(longest), result(longest), limits(longest + 1);
  std::vector<int> roots(longest);
  for (int x = 0; x < mask.width; ++x) {
    for (int y = 0; y < mask.height; ++y) line[std::size_t(y)] = squares.at(x, y);
    transform_line({line.data(), std::size_t(mask.height)}, result, roots, limits);
    for (int y = 0; y < mask.height; ++y) squares.at(x, y) = std::min(result[std::size_t(y)], very_far);
  }
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) line[std::size_t(x)] = squares.at(x, y);
    transform_line({line.data(), std::size_t(mask.width)}, result, roots, limits);
    for (int x = 0; x < mask.width; ++x) squares.at(x, y) = mask.cell_m * std::sqrt(result[std::size_t(x)]);
  }
  return squares;
}

Mask closed(const Mask& mask, float gap_m, float hole_m2) {
  // Grown by half the gap, then shrunk by the same.
  const GroundRaster<float> to_mask = distances_to(mask, 1);
  Mask grown(mask, 0);
  for (std::size_t i = 0; i < mask.cells.size(); ++i) grown.cells[i] = to_mask.cells[i] <= 0.5f * gap_m;
  const GroundRaster<float> to_outside = distances_to(grown, 0);
  Mask result = mask;
  for (std::size_t i = 0; i < mask.cells.size(); ++i)
    if (to_outside.cells[i] > 0.5f * gap_m) result.cells[i] = 1;

  Mask is_seen(mask, 0);
  const auto is_small = [&](std::size_t cells) { return float(cells) * mask.cell_m * mask.cell_m < hole_m2; };
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      if (result.at(x, y) || is_seen.at(x, y)) continue;
      const std::vector<glm::ivec2> hole = region_around(result, {x, y}, is_seen);
      if (!is_small(hole.size())) continue;
      for (const glm::ivec2 cell : hole) result.at(cell.x, cell.y) = 1;
    }
  return result;
}

}  // namespace parvis::scene
