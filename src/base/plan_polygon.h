// Polygons in plan: points of any type with x and y, counter-clockwise or clockwise, in one or several rings.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace parvis {

/// Twice the signed area of the triangle a, b, c: positive where it runs counter-clockwise.
template <class A, class B, class C>
auto twice_area(const A& a, const B& b, const C& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// True for a point inside the ring or on one of its lower or left sides (crossing number: Haines 1994, Point
/// in polygon strategies).
template <class Ring, class Point>
bool is_in_ring(const Ring& ring, const Point& point) {
  bool is_inside = false;
  for (std::size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++)
    if ((ring[i].y > point.y) != (ring[k].y > point.y) &&
        point.x < ring[i].x + (ring[k].x - ring[i].x) * (point.y - ring[i].y) / (ring[k].y - ring[i].y))
      is_inside = !is_inside;
  return is_inside;
}

/// True for a point inside a triangle or on its sides, whichever way it turns.
template <class Triangle, class Point>
bool is_in_triangle(const Triangle& corners, const Point& point) {
  int left = 0, right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto side = twice_area(corners[i], corners[(i + 1) % 3], point);
    left += side > 0, right += side < 0;
  }
  return left == 0 || right == 0;
}

/// Where the line of constant `y` crosses the rings, their x in ascending order: between the first and the
/// second, the third and the fourth and so on the line is inside.
template <class Ring, class Number>
std::vector<Number> crossings_of_line(std::span<const Ring> rings, Number y) {
  std::vector<Number> crossings;
  for (const Ring& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if ((a.y <= y) != (b.y <= y)) crossings.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
    }
  std::ranges::sort(crossings);
  return crossings;
}

}  // namespace parvis
