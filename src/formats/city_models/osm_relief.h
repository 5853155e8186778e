// How high the ways of OpenStreetMap run: bridges pass over what they cross, and ramps lead up to them.
#pragma once

#include <unordered_map>

#include "formats/city_models/osm_areas.h"

namespace parvis::scene {

/// True where the tag is there and does not say no.
bool says_yes(const OsmTags& tags, const std::string& key);
/// True for bridges: bridge=* other than no.
bool is_bridge(const OsmTags& tags);
/// True for what runs below ground. A passage through a building is none.
bool is_underground(const OsmTags& tags);

/// A point of a way: in plan, and its height above the ground.
struct RaisedPoint {
  glm::dvec2 place;
  double above_m;
};

/// Heights of roads and railways above the ground. A bridge over a road or railway leaves it 4.5 m of
/// clearance per layer, one over anything else rises 1 m; from its ends ways fall by 6 % (railways 3 %) until
/// they reach the ground.
class OsmRelief {
 public:
  /// `place` and `osm` must outlive this.
  OsmRelief(const OsmFile& osm, const OsmPlaces& place);

  /// The way's points with those between them where a ramp begins or ends. Nodes that are not in the file are
  /// left out.
  std::vector<RaisedPoint> profile(const OsmWay& way) const;

 private:
  double height_of_bridge(const OsmWay& bridge) const;
  void raise(OsmId node, double above_m);
  void lead_down();

  const OsmFile& osm_;
  const OsmPlaces& place_;
  std::unordered_map<OsmId, double> above_m_;
};

}  // namespace parvis::scene
