// Where a point that is moved by hand comes to rest: on ends, lines, crossings, at right angles, at even
// spacing, on a grid.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace parvis::planner {

/// A line in the plan.
using PlanSegment = std::array<glm::dvec2, 2>;

/// The kind of thing that holds a point.
enum class SnapKind : unsigned char { none, grid, line, spacing, right_angle, crossing, end };

/// Things in the plan on which points may come to rest.
struct SnapTargets {
  std::vector<PlanSegment> lines;    ///< edges of objects, kerbs, walls, lines of drawings
  std::vector<glm::dvec2> ends;      ///< their ends and corners
  std::vector<glm::dvec2> middles;   ///< of objects: for even spacing, and to stand in line
  std::optional<glm::dvec2> origin;  ///< from which right angles are kept; none: they are not
  double grid_m = 0.0;               ///< 0: none
};

/// A point as it rests.
struct Snapped {
  glm::dvec2 at{0.0};
  SnapKind kind = SnapKind::none;
  std::vector<PlanSegment> guides;  ///< lines that show why
};

/// The place nearest to `wanted` that holds it, within `within_m`: ends first, then crossings, right angles,
/// even spacing, lines, and the grid, which holds everywhere. Where `keeps_right_angles`, the place is on one
/// of the axes through the origin whatever else holds it.
Snapped snap(glm::dvec2 wanted, const SnapTargets& targets, double within_m, bool keeps_right_angles = false);

/// Name of a kind of snap in one of the two languages: see words.h.
const char* name_of(SnapKind kind);

}  // namespace parvis::planner
