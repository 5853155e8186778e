// The light in which a tree was photographed, found by the sun's direction and the cells' opacity.
//
// Section 4.8 of the thesis (003_d5b01da2d2f805f6) names the way: "the existence of opacity information
// should allow us to approximate light distribution, and perform approximate lighting or relighting
// calculations".
#pragma once

#include <optional>
#include <vector>

#include "capture/trees/billboard_tree.h"

namespace parvis::trees {

/// Albedo of foliage in the visible (Hosgood and others 2005, LOPEX93: 0.08 to 0.15): the reflectance that
/// the mean of a tree is given, for no photograph says how bright its light was.
inline constexpr float mean_albedo = 0.12f;

/// The light that the cells of a tree transmit.
class CrownShade {
 public:
  /// The tree must outlive it.
  explicit CrownShade(const BillboardTree& tree);
  /// The share of light that reaches a point from a direction (unit), 0..1. `own`: a cell that stops none.
  float passed(glm::vec3 point, glm::vec3 direction, int own = no_cell) const;

 private:
  const CellGrid& grid_;
  std::vector<float> extinction_per_m_;
};

/// Directions of the sky, each of which stands for the same solid angle.
std::vector<glm::vec3> sky_directions();

/// The share of the sun's light that reaches each cell from a direction (unit), 0..1: what the cells between
/// let through.
std::vector<float> sun_visibility(const BillboardTree& tree, glm::vec3 to_sun);
/// The same of a sky that is equally bright everywhere, weighed alike from all sides above.
std::vector<float> sky_visibility(const BillboardTree& tree);

/// Finds the light of the photographs: the brightness of each cell is `sun` times what it sees of the sun
/// plus `sky` times what it sees of the sky, by least squares over the cells. Without `to_sun` the direction
/// is the one that explains most.
CapturedLight estimated_light(const BillboardTree& tree, std::optional<glm::vec3> to_sun = std::nullopt);

}  // namespace parvis::trees
