// Shapes along lines of a map: ribbons, boxes and slopes, as surfaces of a city model.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "formats/city_models/city_assembly.h"
#include "formats/readers/ground_on_map.h"

namespace parvis::scene {

/// Names and colours of the surfaces drawn along a line.
struct LineLook {
  CityObject object;
  int material = no_index;  ///< from CityAssembly::add_material
};

/// A line's cross sections: a point on the left and one on the right at each of its points.
struct Sides {
  std::vector<glm::dvec3> left, right;
};

/// Parallels of a line in plan, `left_m` and `right_m` to the right of it (negative: left), raised by
/// `lift_m`. Corners are mitred, up to twice the distance. Points that coincide in plan are dropped.
Sides sides_of(const std::vector<glm::dvec3>& line, double left_m, double right_m, double lift_m);

/// A level band between two parallels, facing up.
void add_band(const Sides& sides, const LineLook& look, CityAssembly& city);

/// The band on top of walls that reach down by `depth_m`: a hedge, a rail, a deck. Closed at both ends.
void add_block(const Sides& top, double depth_m, const LineLook& look, CityAssembly& city);

/// One polygon of points in order.
void add_polygon(std::vector<glm::dvec3> points, const LineLook& look, CityAssembly& city);

}  // namespace parvis::scene
