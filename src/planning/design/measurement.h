// Rulers, areas, heights and slopes of a design as plain data.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"

namespace parvis::design {

/// The quantity that is measured.
enum class Quantity : unsigned char { distance, area, height, slope };

/// Names of the quantities, in the order of the enumeration: "distance", "area", "height", "slope".
const std::vector<std::string>& quantity_names();

/// A measurement that belongs to a design.
struct Measurement {
  std::string name;    ///< unique in the scene
  std::string design;  ///< that it belongs to
  Quantity quantity = Quantity::distance;
  std::vector<glm::dvec3> points;  ///< in the scene's frame, metres
  bool is_locked = false;
  bool is_visible = true;

  /// Distance: length of the line through all points, m. Area: within the points in plan, m2. Height: of the
  /// second point above the first, m. Slope: rise of the second point above the first by the way in plan,
  /// 0.05 being 5 %.
  double value() const;
  /// The value with its unit: "4.25 m", "+0.45 m", square metres, percent and degrees.
  std::string text() const;
  /// The unit of `value` in tables: "m", "m2", or "1" of a slope.
  const char* unit() const {
    return quantity == Quantity::area ? "m2" : quantity == Quantity::slope ? "1" : "m";
  }
  /// The line that shows it: of an area closed by its first point, of a height level below or above and then
  /// upright.
  std::vector<glm::dvec3> line() const;
  /// Where its text stands.
  glm::dvec3 middle() const;
};

/// Whether these points can be measured. Errors: too few or too many points, a slope without a way in plan,
/// an area without extent or whose outline crosses itself.
Status check_measurement(Quantity quantity, const std::vector<glm::dvec3>& points);

}  // namespace parvis::design
