// Rings of OpenStreetMap as they are drawn, which may touch themselves and each other, as areas with holes.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace parvis::scene {

/// Corners of a ring on the map, metres, without a repeated last one.
using OsmRing = std::vector<glm::dvec2>;

/// A closed line of an area.
struct OsmClosedLine {
  OsmRing ring;
  bool is_inner = false;  ///< by its role
};

/// Points of a map that lie no farther apart are one; those near to a side lie on it.
inline constexpr double same_place_m = 0.02;

/// The areas that closed lines enclose by the rules of multipolygons: sides that two lines have in common are
/// inside or outside, and no border; lines may touch in points. Each area is its outline, counter-clockwise,
/// then its holes, clockwise; no ring visits a point twice. What lies in an odd number of rings is inside,
/// whatever their roles are, but inner lines that lie in no other ring enclose nothing: `lost` counts them.
std::vector<std::vector<OsmRing>> nested_rings(const std::vector<OsmClosedLine>& lines, std::size_t& lost);

}  // namespace parvis::scene
