#include "formats/city_models/osm_relief.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <queue>

#include "base/plan_polygon.h"
#include "formats/city_models/osm_measures.h"
#include "formats/city_models/osm_roads.h"

namespace parvis::scene {
namespace {

using glm::dvec2;

constexpr double bridge_clearance_m = 4.5, deck_depth_m = 0.9;  // below a bridge, and of its deck
constexpr double low_bridge_m = 1.0;                            // over water
constexpr double road_slope = 0.06, street_slope = 0.08, path_slope = 0.12, rail_slope = 0.03;
constexpr double steepest_ramp = 0.15;
constexpr int max_layer = 4;
constexpr double max_steepness = 2.5;         // of ramps to portals, of the usual slope
constexpr double max_bridge_steepness = 1.5;  // the same of ramps to bridges
constexpr double min_raised_m = 1.0;          // above the ground: through what is lower nothing grows
constexpr double loose_m = 2.0;               // above the ground: low bridges that end are piers
constexpr double lowest_ramp_m = 0.05;        // what rises less is level
constexpr int max_ramp_nodes = 10'000;        // that are walked from a portal or bridge to a junction

bool is_road(const OsmTags& tags) { return says_yes(tags, "highway") && tag(tags, "area") != "yes"; }

int layer_of(const OsmTags& tags) {
  const std::string& text = tag(tags, "layer");
  int layer = is_bridge(tags) ? 1 : 0;
  std::from_chars(text.data(), text.data() + text.size(), layer);
  return std::clamp(layer, -max_layer, max_layer);
}

bool cross(dvec2 a, dvec2 b, dvec2 c, dvec2 d) {
  return twice_area(a, b, c) * twice_area(a, b, d) < 0.0 && twice_area(c, d, a) * twice_area(c, d, b) < 0.0;
}

/// A short ramp of a lesser way lifts what lies around it less than a long one.
double slope_of(const OsmTags& tags) {
  if (is_rail(tags)) return rail_slope;
  const std::string& kind = tag(tags, "highway");
  if (kind == "residential" || kind == "living_street" || kind == "unclassified") return street_slope;
  return is_street(tags) && kind != "service" ? road_slope : path_slope;
}

double ramp_slope(double slope, double steepness) { return std::min(steepness * slope, steepest_ramp); }

}  // namespace

bool says_yes(const OsmTags& tags, const std::string& key) {
  const std::string& value = tag(tags, key);
  return !value.empty() && value != "no";
}

bool is_bridge(const OsmTags& tags) { return says_yes(tags, "bridge"); }

bool is_underground(const OsmTags& tags) {
  const bool has_storeys_below_alone =
      number_in(tag(tags, "building:levels")) == 0.0 && says_yes(tags, "building:levels:underground") &&
      tag(tags, "building:levels:underground") != "0" && tag(tags, "height").empty() &&
      tag(tags, "roof:levels").empty() && tag(tags, "roof:height").empty();
  return (says_yes(tags, "tunnel") && tag(tags, "tunnel") != "building_passage") ||
         tag(tags, "location") == "underground" || has_storeys_below_alone;
}

bool is_rail(const OsmTags& tags) {
  const std::string& kind = tag(tags, "railway");
  return kind == "rail" || kind == "light_rail" || kind == "tram" || kind == "narrow_gauge" ||
         kind == "subway";
}

bool is_tunnel(const OsmTags& tags) {
  const bool leads_out =
      is_rail(tags) ? tag(tags, "railway") != "subway" : is_street(tags) && tag(tags, "highway") != "service";
  return is_underground(tags) && leads_out;
}

void each_stretch(const std::vector<RaisedPoint>& profile, double side,
                  const std::function<void(const std::vector<RaisedPoint>&)>& use) {
  std::vector<RaisedPoint> stretch;
  const auto is_off = [&](std::size_t i) { return side * profile[i].above_m > lowest_ramp_m; };
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const bool touches = is_off(i) || (i > 0 && is_off(i - 1)) || (i + 1 < profile.size() && is_off(i + 1));
    if (touches) stretch.push_back(profile[i]);
    if ((!touches || i + 1 == profile.size()) && stretch.size() > 1) use(stretch);
    if (!touches) stretch.clear();
  }
}

OsmRelief::OsmRelief(const OsmFile& osm, const OsmPlaces& place, bool digs) : osm_(osm), place_(place) {
  std::optional<OpenWays> ways;
  for (const OsmWay& way : osm.ways) {
    if (!is_bridge(way.tags) || !(is_road(way.tags) || is_rail(way.tags))) continue;
    if (!ways) ways = open_ways();
    const double above_m = height_of_bridge(way, *ways);
    for (const OsmId node : way.nodes) above_[node].away_m = std::max(above_[node].away_m, above_m);
  }
  const bool has_tunnels =
      digs && std::ranges::any_of(osm.ways, [](const OsmWay& way) { return is_tunnel(way.tags); });
  if (above_.empty() && !has_tunnels) return;
  const Steps along = steps();
  for (auto& [node, level] : above_)
    level.steepness = steepness(along, node, level.away_m, max_bridge_steepness);
  lead_to_ground(along, above_);
  find_loose_ends();
  if (has_tunnels) dig_tunnels(along);
}

/// All roads and railways but those below the ground.
OsmRelief::OpenWays OsmRelief::open_ways() const {
  OpenWays ways;
  for (const OsmWay& way : osm_.ways) {
    if (!(is_road(way.tags) || is_rail(way.tags)) || is_underground(way.tags)) continue;
    for (std::size_t i = 0; i + 1 < way.nodes.size(); ++i)
      if (const auto a = place_(way.nodes[i]), b = place_(way.nodes[i + 1]); a && b) ways.add(*a, *b, &way);
  }
  return ways;
}

/// Compared with the ways that cross it and are no bridge of the same layer or a higher one.
double OsmRelief::height_of_bridge(const OsmWay& bridge, const OpenWays& ways) const {
  const int layer = std::max(layer_of(bridge.tags), 1);
  bool is_over_way = false;
  for (std::size_t k = 0; k + 1 < bridge.nodes.size() && !is_over_way; ++k) {
    const auto from = place_(bridge.nodes[k]), to = place_(bridge.nodes[k + 1]);
    if (!from || !to) continue;
    ways.each_near(*from, *to, [&](const OpenWays::Segment& segment) {
      is_over_way = segment.owner != &bridge && cross(*from, *to, segment.a, segment.b) &&
                    layer_of(segment.owner->tags) < layer;
      return !is_over_way;
    });
  }
  return is_over_way ? double(layer) * (bridge_clearance_m + deck_depth_m) : low_bridge_m;
}

/// The steps of all ways that lie open: ramps are none in tunnels.
OsmRelief::Steps OsmRelief::steps() const {
  Steps steps;
  for (const OsmWay& way : osm_.ways) {
    if (!(is_road(way.tags) || is_rail(way.tags)) || is_underground(way.tags)) continue;
    for (std::size_t i = 0; i + 1 < way.nodes.size(); ++i) {
      const auto a = place_(way.nodes[i]), b = place_(way.nodes[i + 1]);
      if (!a || !b) continue;
      const double length_m = glm::distance(*a, *b), slope = slope_of(way.tags);
      steps[way.nodes[i]].push_back({way.nodes[i + 1], length_m, slope, is_bridge(way.tags)});
      steps[way.nodes[i + 1]].push_back({way.nodes[i], length_m, slope, is_bridge(way.tags)});
    }
  }
  return steps;
}

/// Dijkstra's algorithm from the bridges or portals along all ways, heights falling with the distance.
void OsmRelief::lead_to_ground(const Steps& steps, Levels& levels) {
  std::priority_queue<std::pair<double, OsmId>> farthest;
  for (const auto& [node, level] : levels) farthest.emplace(level.away_m, node);
  while (!farthest.empty()) {
    const auto [away_m, node] = farthest.top();
    farthest.pop();
    const Level here = levels[node];
    const auto ways = steps.find(node);
    if (away_m < here.away_m || ways == steps.end()) continue;
    for (const Step& step : ways->second) {
      const double there_m = away_m - ramp_slope(step.slope, here.steepness) * step.length_m;
      if (there_m <= 0.0 || there_m <= levels[step.to].away_m) continue;
      levels[step.to] = {there_m, here.steepness};
      farthest.emplace(there_m, step.to);
    }
  }
}

/// So steep that the ramp from the end of a bridge or tunnel reaches the ground before the next junction,
/// where that is possible.
double OsmRelief::steepness(const Steps& steps, OsmId end, double away_m, double limit) {
  double fall_m = 0.0;
  OsmId before = end, node = end;
  for (int i = 0; i < max_ramp_nodes; ++i) {
    const Step* next = nullptr;
    int count = 0;
    if (const auto ways = steps.find(node); ways != steps.end())
      for (const Step& step : ways->second)
        if (step.to != before && !(node == end && step.is_on_bridge)) next = &step, ++count;
    if (count > 1) break;
    if (next == nullptr || fall_m > away_m) return 1.0;  // the way ends, or the ramp has room
    fall_m += next->slope * next->length_m, before = node, node = next->to;
  }
  return std::clamp(away_m / std::max(fall_m, 1e-6), 1.0, limit);
}

void OsmRelief::dig_tunnels(const Steps& steps) {
  for (const OsmWay& way : osm_.ways) {
    if (!is_tunnel(way.tags)) continue;
    const double depth_m = double(std::max(-layer_of(way.tags), 1)) * tunnel_depth_m;
    for (const OsmId node : way.nodes) below_[node].away_m = std::max(below_[node].away_m, depth_m);
  }
  for (auto& [node, level] : below_) level.steepness = steepness(steps, node, level.away_m, max_steepness);
  lead_to_ground(steps, below_);
}

/// The level of a node above the ground, negative below it.
OsmRelief::Level OsmRelief::level_of(OsmId node) const {
  const auto above = above_.find(node), below = below_.find(node);
  if (above != above_.end() && above->second.away_m > 0.0) return above->second;
  if (below == below_.end()) return {};
  return {-below->second.away_m, below->second.steepness};
}

/// Where other ways, areas or buildings use the node, the street leads there.
void OsmRelief::find_loose_ends() {
  std::unordered_map<OsmId, int> uses;
  for (const OsmWay& way : osm_.ways) {
    if (!is_street(way.tags) || way.nodes.size() < 2) continue;
    for (const OsmId end : {way.nodes.front(), way.nodes.back()})
      if (level_of(end).away_m > loose_m) uses.emplace(end, 0);
  }
  if (uses.empty()) return;
  for (const OsmWay& way : osm_.ways)
    for (const OsmId node : way.nodes)
      if (const auto end = uses.find(node); end != uses.end()) ++end->second;
  for (const auto& [end, count] : uses)
    if (count == 1) loose_ends_.insert(end);
}

/// Straight on from the ends of a street that are loose, down to the ground.
std::vector<RaisedPoint> OsmRelief::with_run_outs(const OsmWay& way, std::vector<RaisedPoint> points) const {
  if (loose_ends_.empty() || !is_street(way.tags)) return points;
  for (const OsmId end : {way.nodes.front(), way.nodes.back()}) {
    std::ranges::reverse(points);  // twice: the end of the first round is the way's first point
    if (!loose_ends_.contains(end) || points.size() < 2) continue;
    const RaisedPoint last = points.back();
    const dvec2 along = last.place - points[points.size() - 2].place;
    if (glm::length(along) <= 0.0 || !place_(end)) continue;
    points.push_back({last.place + glm::normalize(along) * (last.above_m / road_slope), 0.0});
  }
  return points;
}

std::vector<RaisedPoint> OsmRelief::profile(const OsmWay& way) const {
  std::vector<RaisedPoint> nodes;
  std::vector<double> slopes;
  for (const OsmId node : way.nodes)
    if (const auto point = place_(node)) {
      const Level level = level_of(node);
      nodes.push_back({*point, level.away_m});
      slopes.push_back(ramp_slope(slope_of(way.tags), level.steepness));
    }
  if (is_bridge(way.tags) || is_underground(way.tags)) return with_run_outs(way, std::move(nodes));
  std::vector<RaisedPoint> points;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    points.push_back(nodes[i]);
    if (i + 1 == nodes.size()) break;
    const RaisedPoint &a = nodes[i], &b = nodes[i + 1];
    const double length_m = glm::distance(a.place, b.place);
    const double from_m = std::abs(a.above_m), to_m = std::abs(b.above_m);
    const double down_m = from_m / slopes[i], up_m = length_m - to_m / slopes[i + 1];
    const auto add = [&](double at_m, double above_m) {
      if (at_m > 0.5 && at_m < length_m - 0.5)
        points.push_back({glm::mix(a.place, b.place, at_m / length_m), above_m});
    };
    if (down_m <= up_m) {
      if (from_m > 0.0) add(down_m, 0.0);
      if (to_m > 0.0) add(up_m, 0.0);
    } else if (a.above_m * b.above_m > 0.0) {  // the two ramps meet before they reach the ground
      const double valley_m = (from_m - to_m + slopes[i + 1] * length_m) / (slopes[i] + slopes[i + 1]);
      add(valley_m, std::copysign(from_m - slopes[i] * valley_m, a.above_m));
    }
  }
  return with_run_outs(way, std::move(points));
}

RaisedWays::RaisedWays(const OsmFile& osm, const OsmRelief& relief) {
  for (const OsmWay& way : osm.ways) {
    const double half_m = half_carriageway_m(way);
    if (half_m <= 0.0 || is_underground(way.tags)) continue;
    const std::vector<RaisedPoint> points = relief.profile(way);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      if (std::max(points[i].above_m, points[i + 1].above_m) > min_raised_m)
        decks_.add(points[i].place, points[i + 1].place, half_m + beside_carriageway_m);
  }
}

bool RaisedWays::are_near(dvec2 point, double beside_m) const {
  bool is_near = false;
  decks_.each_near(point, point, [&](const OsmSegments<double>::Segment& deck) {
    const dvec2 along = deck.b - deck.a;
    const double share =
        std::clamp(glm::dot(point - deck.a, along) / std::max(glm::dot(along, along), 1e-9), 0.0, 1.0);
    is_near = glm::distance(point, deck.a + share * along) < deck.owner + beside_m;
    return !is_near;
  });
  return is_near;
}

}  // namespace parvis::scene
