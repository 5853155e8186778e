#include "places/car_bodies/side_view.h"

#include <algorithm>
#include <cmath>

namespace parvis::car_bodies {

SideView::SideView(const Body& body) : bounds_(body.bounds()), middle_y_(body.middle_y()) {
  columns_ = int(bounds_.size().x / cell_m) + 1;
  rows_ = int(bounds_.size().z / cell_m) + 1;
  depths_.assign(std::size_t(columns_) * std::size_t(rows_), nothing);
  for (std::size_t part = 0; part < body.model().parts.size(); ++part)
    for (std::size_t i = 0; i < body.model().parts[part].mesh.triangle_count(); ++i)
      add(body.corners(part, i));
}

float SideView::openings_m2() const {
  constexpr float from_fraction = 0.5f;
  std::size_t cells = 0;
  std::vector<bool> is_below_skin(std::size_t(columns_), false);
  for (int row = rows_ - 1; row >= row_at(from_fraction); --row) {
    int first = columns_, last = -1;
    for (int column = 0; column < columns_; ++column)
      if (depth(column, row) != nothing) first = std::min(first, column), last = column;
    for (int column = 0; column < columns_; ++column) {
      const bool is_open = depth(column, row) == nothing;
      if (!is_open) is_below_skin[std::size_t(column)] = true;
      if (is_open && column > first && column < last && is_below_skin[std::size_t(column)]) ++cells;
    }
  }
  return float(cells) * cell_m * cell_m;
}

/// Rasterises a triangle at the middles of cells.
void SideView::add(const std::array<glm::vec3, 3>& corners) {
  glm::vec2 at[3];
  float out[3];
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = glm::vec2(corners[k].x - bounds_.min.x, corners[k].z - bounds_.min.z) / cell_m - 0.5f;
    out[k] = std::abs(corners[k].y - middle_y_);
  }
  const auto cross = [](glm::vec2 a, glm::vec2 b) { return a.x * b.y - a.y * b.x; };
  const float area = cross(at[1] - at[0], at[2] - at[0]);
  if (!(std::abs(area) > 1e-9f)) return;
  const glm::vec2 low = glm::min(at[0], glm::min(at[1], at[2])),
                  high = glm::max(at[0], glm::max(at[1], at[2]));
  for (int row = std::max(0, int(std::ceil(low.y))); row <= std::min(rows_ - 1, int(high.y)); ++row)
    for (int column = std::max(0, int(std::ceil(low.x))); column <= std::min(columns_ - 1, int(high.x));
         ++column) {
      const glm::vec2 here{float(column), float(row)};
      const float u = cross(at[1] - here, at[2] - here) / area, v = cross(at[2] - here, at[0] - here) / area;
      if (u < 0.0f || v < 0.0f || u + v > 1.0f) continue;
      float& depth = depths_[std::size_t(row * columns_ + column)];
      depth = std::max(depth, u * out[0] + v * out[1] + (1.0f - u - v) * out[2]);
    }
}

}  // namespace parvis::car_bodies
