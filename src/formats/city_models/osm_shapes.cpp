#include "formats/city_models/osm_shapes.h"

#include <algorithm>
#include <cmath>

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;

constexpr double same_point_m = 0.01;
constexpr double max_mitre = 2.0;

dvec2 right_in_plan(dvec2 direction) { return {direction.y, -direction.x}; }

}  // namespace

Sides sides_of(const std::vector<dvec3>& line, double left_m, double right_m, double lift_m) {
  std::vector<dvec3> points;
  for (const dvec3& point : line)
    if (points.empty() || glm::distance(dvec2(points.back()), dvec2(point)) > same_point_m)
      points.push_back(point);
  Sides sides;
  if (points.size() < 2) return sides;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const dvec2 in =
        glm::normalize(dvec2(points[std::max<std::size_t>(i, 1)] - points[std::max<std::size_t>(i, 1) - 1]));
    const std::size_t last = points.size() - 1;
    const dvec2 out =
        glm::normalize(dvec2(points[std::min(i + 1, last)] - points[std::min(i + 1, last) - 1]));
    const dvec2 sum = right_in_plan(in) + right_in_plan(out);
    const dvec2 middle = glm::length(sum) > 1e-6 ? glm::normalize(sum) : right_in_plan(out);
    const double mitre = std::min(1.0 / std::max(glm::dot(middle, right_in_plan(out)), 1e-3), max_mitre);
    sides.left.emplace_back(dvec2(points[i]) + middle * (mitre * left_m), points[i].z + lift_m);
    sides.right.emplace_back(dvec2(points[i]) + middle * (mitre * right_m), points[i].z + lift_m);
  }
  return sides;
}

void add_polygon(std::vector<dvec3> points, const LineLook& look, CityAssembly& city) {
  CitySurface surface;
  surface.rings.push_back(std::move(points));
  surface.material = look.material;
  city.add(look.object, surface);
}

void add_band(const Sides& sides, const LineLook& look, CityAssembly& city) {
  for (std::size_t i = 0; i + 1 < sides.left.size(); ++i) {
    const bool is_twisted =
        std::abs((sides.left[i].z - sides.right[i].z) - (sides.left[i + 1].z - sides.right[i + 1].z)) > 1e-3;
    if (is_twisted) {  // its corners lie in no plane
      add_polygon({sides.right[i], sides.right[i + 1], sides.left[i + 1]}, look, city);
      add_polygon({sides.right[i], sides.left[i + 1], sides.left[i]}, look, city);
    } else {
      add_polygon({sides.right[i], sides.right[i + 1], sides.left[i + 1], sides.left[i]}, look, city);
    }
  }
}

void add_block(const Sides& top, double depth_m, const LineLook& look, CityAssembly& city) {
  if (top.left.empty()) return;
  const auto below = [depth_m](dvec3 point) { return point - dvec3(0.0, 0.0, depth_m); };
  const auto wall = [&](const dvec3& from, const dvec3& to) {
    add_polygon({below(from), below(to), to, from}, look, city);
  };
  add_band(top, look, city);
  for (std::size_t i = 0; i + 1 < top.left.size(); ++i) {
    wall(top.right[i], top.right[i + 1]);
    wall(top.left[i + 1], top.left[i]);
  }
  wall(top.left.front(), top.right.front());
  wall(top.right.back(), top.left.back());
}

}  // namespace parvis::scene
