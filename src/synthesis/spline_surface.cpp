#include "synthesis/spline_surface.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace parvis::synthesis {
namespace {

std::array<float, 4> value_weights(float t) {
  const float s = 1.0f - t;
  return {s * s * s / 6.0f, (3.0f * t * t * t - 6.0f * t * t + 4.0f) / 6.0f,
          (-3.0f * t * t * t + 3.0f * t * t + 3.0f * t + 1.0f) / 6.0f, t * t * t / 6.0f};
}

std::array<float, 4> slope_weights(float t) {
  const float s = 1.0f - t;
  return {-0.5f * s * s, 1.5f * t * t - 2.0f * t, -1.5f * t * t + t + 0.5f, 0.5f * t * t};
}

glm::vec3 mirrored(glm::vec3 p) { return {p.x, -p.y, p.z}; }

}  // namespace

SplineSurface::SplineSurface(int columns, int rows, std::vector<glm::vec3> control_points)
    : columns_(columns), rows_(rows), points_(std::move(control_points)) {
  assert(points_.size() == std::size_t(columns) * std::size_t(rows) && columns >= 4 && rows >= 4);
}

/// The control net continues beyond the planes of symmetry as the other half, beyond the free edge straight.
glm::vec3 SplineSurface::control_point(int column, int row) const {
  if (column < 0) return mirrored(control_point(-column, row));
  if (column >= columns_) return mirrored(control_point(2 * (columns_ - 1) - column, row));
  if (row >= rows_) return mirrored(control_point(column, 2 * (rows_ - 1) - row));
  if (row < 0) return 2.0f * control_point(column, 0) - control_point(column, -row);
  return points_[std::size_t(column) * std::size_t(rows_) + std::size_t(row)];
}

glm::vec3 SplineSurface::blend(float u, float v, bool along_u, bool along_v) const {
  const int i = std::clamp(int(std::floor(u)), 0, columns_ - 2),
            j = std::clamp(int(std::floor(v)), 0, rows_ - 2);
  const float tu = u - float(i), tv = v - float(j);
  const std::array<float, 4> wu = along_u ? slope_weights(tu) : value_weights(tu);
  const std::array<float, 4> wv = along_v ? slope_weights(tv) : value_weights(tv);
  glm::vec3 sum(0.0f);
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      sum += wu[std::size_t(a)] * wv[std::size_t(b)] * control_point(i + a - 1, j + b - 1);
  return sum;
}

glm::vec3 SplineSurface::position(float u, float v) const { return blend(u, v, false, false); }

glm::vec3 SplineSurface::normal(float u, float v) const {
  const glm::vec3 across = glm::cross(blend(u, v, true, false), blend(u, v, false, true));
  if (glm::length(across) > 1e-6f) return glm::normalize(across);
  // Where both midlines meet the net is folded flat: look a little inward.
  const float inward = 0.02f;
  return normal(std::clamp(u, inward, end_u() - inward), std::min(v, end_v() - inward));
}

}  // namespace parvis::synthesis
