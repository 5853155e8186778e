// Which ground a sun study judges by the rule for open space: that of certain things, within an outline.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "graphics/reference/ray_scene.h"
#include "scene/data/scene.h"

namespace parvis::sun_hours {

/// The part of the ground that is judged. Both together: the part that lies in both.
struct JudgedGround {
  /// Names or patterns (scene/data/name_pattern.h) of objects, of parts or materials of their models, or of
  /// kinds of photographed things; empty: of all.
  std::vector<std::string> names;
  std::vector<glm::dvec2>
      outline;  ///< corners of a polygon, as `checked_outline` gives it; empty: everywhere

  /// True if all open ground is judged.
  bool is_all() const { return names.empty() && outline.empty(); }
};

/// The outline with each corner once. Fails where it has fewer than three or more than 1,000 corners, no
/// area, or sides that cross or touch each other; it may run either way round.
Result<std::vector<glm::dvec2>> checked_outline(std::vector<glm::dvec2> corners);

/// A flag for each cell of a grid, row by row from `corner` on: its middle lies inside the outline.
std::vector<std::uint8_t> cells_inside(const std::vector<glm::dvec2>& outline, glm::dvec2 corner,
                                       double cell_m, int columns, int rows);

/// The surfaces of a scene that names say.
class NamedSurfaces {
 public:
  /// Fails where nothing of the scene has one of the names, and lists those that there are.
  static Result<NamedSurfaces> find(const scene::Scene& scene, const std::vector<std::string>& names);
  /// Whether a surface of a RayScene of that scene is one of them.
  bool has(const reference::PlacedPart& place) const;

 private:
  std::vector<std::vector<std::uint8_t>> parts_;  ///< of each object, a flag for each part of its model
  std::vector<std::uint8_t> things_;              ///< beyond the objects: of what rooms draw by themselves
};

}  // namespace parvis::sun_hours
