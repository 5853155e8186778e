#include "planning/design/measurement.h"

#include <fmt/format.h>

#include <cmath>

#include "planning/design/placed_object.h"
#include "planning/design/shape_models.h"

namespace parvis::design {
namespace {

constexpr double min_way_m = 1e-3, min_area_m2 = 1e-4;
constexpr std::size_t max_points = 10'000;

}  // namespace

const std::vector<std::string>& quantity_names() {
  static const std::vector<std::string> names{"distance", "area", "height", "slope"};
  return names;
}

double Measurement::value() const {
  if (points.size() < 2) return 0.0;
  const glm::dvec3 &first = points.front(), &last = points.back();
  switch (quantity) {
    case Quantity::height:
      return last.z - first.z;
    case Quantity::slope:
      return (last.z - first.z) / glm::distance(glm::dvec2(first), glm::dvec2(last));
    case Quantity::area: {
      const std::vector<glm::dvec2> plan(points.begin(), points.end());
      return std::abs(signed_area_m2(plan));
    }
    case Quantity::distance:
      break;
  }
  double length_m = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) length_m += glm::distance(points[i], points[i + 1]);
  return length_m;
}

std::string Measurement::text() const {
  switch (quantity) {
    case Quantity::height:
      return fmt::format("{:+.2f} m", value());
    case Quantity::slope:
      return fmt::format("{:.1f} % ({:.1f}\u00b0)", 100.0 * value(), glm::degrees(std::atan(value())));
    case Quantity::area:
      return fmt::format("{:.2f} m\u00b2", value());
    case Quantity::distance:
      break;
  }
  return fmt::format("{:.2f} m", value());
}

std::vector<glm::dvec3> Measurement::line() const {
  std::vector<glm::dvec3> line = points;
  if (quantity == Quantity::area && !points.empty()) line.push_back(points.front());
  if (quantity == Quantity::height && points.size() == 2)
    line.insert(line.begin() + 1, glm::dvec3(glm::dvec2(points[1]), points[0].z));
  return line;
}

glm::dvec3 Measurement::middle() const {
  if (points.empty()) return glm::dvec3(0.0);
  if (quantity == Quantity::height && points.size() == 2)
    return {glm::dvec2(points[1]), 0.5 * (points[0].z + points[1].z)};
  if (quantity == Quantity::distance) {
    const std::size_t half = (points.size() - 1) / 2;
    return 0.5 * (points[half] + points[std::min(half + 1, points.size() - 1)]);
  }
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& point : points) sum += point;
  return sum / double(points.size());
}

Status check_measurement(Quantity quantity, const std::vector<glm::dvec3>& points) {
  const std::string& name = quantity_names()[std::size_t(quantity)];
  if (points.size() > max_points)
    return error("{} points are too many for a {}; at most {}", points.size(), name, max_points);
  switch (quantity) {
    case Quantity::distance:
      if (points.size() < 2) return error("a distance has two points or more, not {}", points.size());
      break;
    case Quantity::area: {
      if (points.size() < 3) return error("an area has three corners or more, not {}", points.size());
      const std::vector<glm::vec3> outline(points.begin(), points.end());
      const std::vector<glm::dvec2> plan(points.begin(), points.end());
      if (std::abs(signed_area_m2(plan)) < min_area_m2 ||
          surface_model(outline, surface_names().front(), glm::vec3(1.0f)).parts.empty())
        return error("the outline has no area or crosses itself; give its corners in order");
      break;
    }
    case Quantity::height:
    case Quantity::slope:
      if (points.size() != 2) return error("a {} has two points, not {}", name, points.size());
      if (quantity == Quantity::slope &&
          glm::distance(glm::dvec2(points[0]), glm::dvec2(points[1])) < min_way_m)
        return error("a slope has two places side by side; these lie one above the other");
      break;
  }
  return Ok{};
}

}  // namespace parvis::design
