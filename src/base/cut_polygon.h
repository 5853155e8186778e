// Clips convex polygons, whatever their points hold beside a place.
#pragma once

#include <vector>

namespace parvis {

/// The part of a convex polygon in which `distance(point)` is not negative (Sutherland and Hodgman 1974:
/// Reentrant polygon clipping). `distance` is linear over the polygon; `mix(a, b, share)` makes the points
/// between two others.
template <class Point, class Distance>
std::vector<Point> cut(const std::vector<Point>& polygon, const Distance& distance) {
  std::vector<Point> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const auto from = distance(a), to = distance(b);
    if (from >= 0) kept.push_back(a);
    if ((from >= 0) != (to >= 0)) kept.push_back(mix(a, b, from / (from - to)));
  }
  return kept;
}

}  // namespace parvis
