// Roofs of OpenStreetMap after the tag roof:shape of the wiki's "Simple 3D Buildings".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/city_models/osm_areas.h"

namespace parvis::scene {

/// What a building's tags say of its roof.
struct OsmRoofTags {
  std::string shape;                    ///< value of roof:shape
  bool runs_across = false;             ///< roof:orientation=across: the ridge runs along the shorter sides
  std::optional<double> direction_deg;  ///< roof:direction: where a skillion falls to, clockwise from north
};

/// A face of a roof, or of the walls between the eaves and the roof.
struct OsmRoofFace {
  const char* semantics;           ///< "RoofSurface" or "WallSurface"
  std::vector<glm::dvec3> points;  ///< counter-clockwise seen from outside; z from the ground on
};

/// Whether `osm_roof` gives this outline (without points along its sides) a roof of this shape: cones and
/// pyramids stand on any outline; skillions, domes, onions and mansard roofs on convex ones; gabled, hipped,
/// half-hipped, gambrel, saltbox and round ones on four corners. What is not in the list is flat.
bool has_osm_roof(const OsmRoofTags& tags, const OsmRing& corners);

/// The height of such a roof, metres, where no tag gives it.
double usual_osm_roof_m(const OsmRoofTags& tags, const OsmRing& corners);

/// The faces between the eaves and the top. `corners` run counter-clockwise and `has_osm_roof` holds.
std::vector<OsmRoofFace> osm_roof(const OsmRoofTags& tags, const OsmRing& corners, double eaves_m,
                                  double top_m);

}  // namespace parvis::scene
