// How high the ways of OpenStreetMap run: bridges pass over what they cross, tunnels under it, and ramps lead
// up and down to them.
#pragma once

#include <functional>
#include <unordered_map>
#include <unordered_set>

#include "formats/city_models/osm_areas.h"
#include "formats/city_models/osm_segments.h"

namespace parvis::scene {

/// True where the tag is there and does not say no.
bool says_yes(const OsmTags& tags, const std::string& key);
/// True for bridges: bridge=* other than no.
bool is_bridge(const OsmTags& tags);
/// True for what lies below ground: tunnels, location=underground, and buildings that have storeys there
/// alone. A passage through a building does not.
bool is_underground(const OsmTags& tags);
/// True for railways and tram tracks, by their kind; underground railways (subway) among them.
bool is_rail(const OsmTags& tags);
/// True for tunnels that are dug: of streets and of railways. Ramps of underground garages, footpaths and
/// underground railways, which seldom see daylight, are none.
bool is_tunnel(const OsmTags& tags);

/// Width of a deck beside its carriageway: pavements.
inline constexpr double beside_carriageway_m = 3.1;

/// A point of a way: in plan, and its height above the ground, negative below it.
struct RaisedPoint {
  glm::dvec2 place;
  double above_m;
};

/// Calls use(stretch) for the parts of a profile that lie above the ground (`side` 1) or below it (-1), with
/// the points at which they reach it.
void each_stretch(const std::vector<RaisedPoint>& profile, double side,
                  const std::function<void(const std::vector<RaisedPoint>&)>& use);

/// Heights of roads and railways above the ground. A bridge over a road or railway leaves it 4.5 m of
/// clearance per layer, one over anything else rises 1 m; from its ends ways fall by 6 % (residential streets
/// 8 %, service roads and paths 12 %, railways 3 %) until they reach the ground, up to 1.5 times as steeply
/// where a junction is near. Tunnels lie 5.1 m per layer below it; ways fall to their portals by the same
/// slopes, or up to 2.5 times as steeply, at most 15 %. A street that ends above the ground, where the map is
/// cut off, goes straight on down to it.
class OsmRelief {
 public:
  /// Height of the ceiling of a tunnel above its carriageway, and depth of the carriageway per layer.
  static constexpr double tunnel_clearance_m = 4.5, tunnel_depth_m = 5.1;

  /// `place` and `osm` must outlive this. Where `digs` is false, tunnels do not count.
  OsmRelief(const OsmFile& osm, const OsmPlaces& place, bool digs);

  /// The way's points with those between them where a ramp begins or ends, and those to which a street goes
  /// on beyond its end. Nodes that are not in the file are left out.
  std::vector<RaisedPoint> profile(const OsmWay& way) const;

 private:
  /// A way from a node to the next one, and its usual slope, rise over run.
  struct Step {
    OsmId to;
    double length_m, slope;
    bool is_on_bridge;
  };
  using Steps = std::unordered_map<OsmId, std::vector<Step>>;
  /// How far a node lies above or below the ground, and how steep the ramp there is: 1 is the usual slope.
  struct Level {
    double away_m = 0.0, steepness = 1.0;
  };
  using Levels = std::unordered_map<OsmId, Level>;

  using OpenWays = OsmSegments<const OsmWay*>;

  OpenWays open_ways() const;
  double height_of_bridge(const OsmWay& bridge, const OpenWays& ways) const;
  Steps steps() const;
  static double steepness(const Steps& steps, OsmId end, double away_m, double limit);
  static void lead_to_ground(const Steps& steps, Levels& levels);
  void dig_tunnels(const Steps& steps);
  void find_loose_ends();
  std::vector<RaisedPoint> with_run_outs(const OsmWay& way, std::vector<RaisedPoint> points) const;
  Level level_of(OsmId node) const;

  const OsmFile& osm_;
  const OsmPlaces& place_;
  Levels above_, below_;
  std::unordered_set<OsmId> loose_ends_;  ///< nodes high above the ground at which a street ends
};

/// The plan of bridges and ramps, beside and below which no tree has room.
class RaisedWays {
 public:
  /// The decks of all ways that lie more than a metre above the ground.
  RaisedWays(const OsmFile& osm, const OsmRelief& relief);
  /// True where a deck, with the pavements on it, is nearer than `beside_m` to a point in plan.
  bool are_near(glm::dvec2 point, double beside_m) const;

 private:
  OsmSegments<double> decks_;  ///< with half the width of each
};

}  // namespace parvis::scene
