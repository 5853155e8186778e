// Roofs of OpenStreetMap after the tag roof:shape of the wiki's "Simple 3D Buildings".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/city_models/osm_areas.h"
#include "formats/city_models/straight_skeleton.h"

namespace parvis::scene {

/// A roof as a building's tags describe it.
struct OsmRoofTags {
  std::string shape;         ///< value of roof:shape
  bool runs_across = false;  ///< roof:orientation=across: the ridge runs along the shorter sides
  /// roof:direction: where the main face falls to, clockwise from north. A ridge is square to it.
  std::optional<double> direction_deg = {};
  std::optional<double> angle_deg = {};  ///< roof:angle: slope of its faces
};

/// A face of a roof, or of the walls between the eaves and the roof.
struct OsmRoofFace {
  const char* semantics;           ///< "RoofSurface" or "WallSurface"
  std::vector<glm::dvec3> points;  ///< counter-clockwise seen from outside; z from the ground on
};

/// A roof that stands on an outline.
struct OsmRoof {
  std::string shape;  ///< the wiki's name
  OsmRoofTags tags;
  OsmRing corners;                           ///< of the outline, counter-clockwise
  std::optional<StraightSkeleton> skeleton;  ///< of roofs that follow it
  std::vector<bool> is_gable;                ///< for each face of the skeleton
};

/// The roof for a building's rings (the outline counter-clockwise, then courtyards clockwise, by
/// `corners_of`). Hipped and gabled roofs stand on any outline that has a straight skeleton, with courtyards
/// too; half-hipped, gambrel, saltbox and round ones on four corners, and are gabled elsewhere; pyramids and
/// cones where all corners see their middle, and are hipped elsewhere; skillions, domes, onions and mansard
/// roofs on convex outlines. Nothing for flat roofs, and for those that cannot stand: then `why_flat` becomes
/// the reason and what to do.
std::optional<OsmRoof> find_osm_roof(const OsmRoofTags& tags, const std::vector<OsmRing>& rings,
                                     std::string& why_flat);

/// The height of a roof, metres, where no tag gives it: by roof:angle where its faces have one slope.
double usual_osm_roof_m(const OsmRoof& roof);

/// The faces between the eaves and the top.
std::vector<OsmRoofFace> osm_roof_faces(const OsmRoof& roof, double eaves_m, double top_m);

}  // namespace parvis::scene
