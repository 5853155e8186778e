#include "places/kerbside/cells_under.h"

#include <algorithm>
#include <cmath>

#include "base/cut_polygon.h"

namespace parvis::kerbside {
namespace {

/// The part where low <= corner[axis] <= high.
Corners between(const Corners& polygon, int axis, double low, double high) {
  const Corners above = cut(polygon, [&](const glm::dvec3& corner) { return corner[axis] - low; });
  return cut(above, [&](const glm::dvec3& corner) { return high - corner[axis]; });
}

/// The first and last of `count` cells along an axis, for corners in units of cells.
std::pair<int, int> cells_along(const Corners& polygon, int axis, int count) {
  double low = count, high = 0.0;
  for (const glm::dvec3& corner : polygon)
    low = std::min(low, corner[axis]), high = std::max(high, corner[axis]);
  const double last = count - 1;
  return {int(std::clamp(std::floor(low), 0.0, last)), int(std::clamp(std::floor(high), 0.0, last))};
}

}  // namespace

void each_cell_under(const scene::GroundGrid& grid, Corners polygon,
                     const std::function<void(glm::ivec2, const Corners&)>& use) {
  const glm::dvec2 origin(grid.origin);
  const double cell_m = grid.cell_m;
  for (glm::dvec3& corner : polygon) {
    if (!std::isfinite(corner.x + corner.y + corner.z)) return;
    // In units of cells, whose edges are whole numbers: what stands on an edge is on one side of it.
    corner = glm::dvec3((glm::dvec2(corner) - origin) / cell_m, corner.z);
  }
  polygon = between(between(polygon, 0, 0.0, grid.width), 1, 0.0, grid.height);
  if (polygon.empty()) return;
  const auto [bottom, top] = cells_along(polygon, 1, grid.height);
  for (int y = bottom; y <= top; ++y) {
    const Corners row = bottom == top ? polygon : between(polygon, 1, y, y + 1);
    if (row.empty()) continue;
    const auto [left, right] = cells_along(row, 0, grid.width);
    for (int x = left; x <= right; ++x) {
      Corners part = left == right ? row : between(row, 0, x, x + 1);
      for (glm::dvec3& corner : part) corner = glm::dvec3(origin + cell_m * glm::dvec2(corner), corner.z);
      if (!part.empty()) use({x, y}, part);
    }
  }
}

}  // namespace parvis::kerbside
