// A car body as seen from its side: a raster of how far out its skin lies.
#pragma once

#include <vector>

#include "places/car_bodies/body.h"

namespace parvis::car_bodies {

/// Cells of 2 cm; columns along x, rows upward. Both sides of the body lie on one another.
class SideView {
 public:
  static constexpr float cell_m = 0.02f;
  static constexpr float nothing = -1.0f;

  explicit SideView(const Body& body);

  const Bounds& bounds() const { return bounds_; }  ///< of the body
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  /// Distance of the outermost surface from the middle plane, metres; `nothing` where there is none.
  float depth(int column, int row) const {
    return depths_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)];
  }
  /// Position of a column's middle.
  float x(int column) const { return bounds_.min.x + (float(column) + 0.5f) * cell_m; }
  /// Height of a row's lower edge.
  float z(int row) const { return bounds_.min.z + float(row) * cell_m; }
  /// The row at a fraction of the height of the body.
  int row_at(float fraction) const { return std::min(int(fraction * float(rows_)), rows_ - 1); }

  /// Area of the openings above half of the height through which one looks from side to side: windows without
  /// panes, square metres.
  float openings_m2() const;

 private:
  void add(const std::array<glm::vec3, 3>& corners);

  Bounds bounds_;
  float middle_y_;
  int columns_ = 0, rows_ = 0;
  std::vector<float> depths_;
};

}  // namespace parvis::car_bodies
