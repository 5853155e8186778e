// What of a car is seen from outside, as against seats, linings and the undersides of panels.
#pragma once

#include <vector>

#include "places/car_bodies/body.h"

namespace parvis::car_bodies {

/// Rasters of the outermost surface from the front, the rear, both sides and above.
class OuterSkin {
 public:
  explicit OuterSkin(const Body& body);

  /// True for points on the surface that one of the five views sees, or close behind it.
  bool holds(glm::vec3 point) const;

 private:
  struct View {
    int axis;         ///< along which it looks
    float sign;       ///< of the side from which it looks
    int columns = 0;  ///< cells along the first of the two other axes
    std::vector<float> outermost;
  };
  /// The cell of a point in a view.
  std::size_t cell(const View& view, glm::vec3 point) const;
  int columns(int axis) const;

  Bounds bounds_;
  std::vector<View> views_;
};

}  // namespace parvis::car_bodies
