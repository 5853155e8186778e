#include "formats/city_models/osm_relief.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <queue>

namespace parvis::scene {
namespace {

using glm::dvec2;

constexpr double clearance_m = 4.5, deck_m = 0.9;  // below a bridge, and of its deck
constexpr double low_bridge_m = 1.0;               // over water
constexpr double road_slope = 0.06, rail_slope = 0.03;
constexpr int max_layer = 4;

bool is_rail(const OsmTags& tags) {
  const std::string& kind = tag(tags, "railway");
  return kind == "rail" || kind == "light_rail" || kind == "tram" || kind == "narrow_gauge" ||
         kind == "subway";
}

bool is_road(const OsmTags& tags) { return says_yes(tags, "highway") && tag(tags, "area") != "yes"; }

int layer_of(const OsmTags& tags) {
  const std::string& text = tag(tags, "layer");
  int layer = is_bridge(tags) ? 1 : 0;
  std::from_chars(text.data(), text.data() + text.size(), layer);
  return std::clamp(layer, -max_layer, max_layer);
}

double turn(dvec2 a, dvec2 b, dvec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

bool cross(dvec2 a, dvec2 b, dvec2 c, dvec2 d) {
  return turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0;
}

double slope_of(const OsmTags& tags) { return is_rail(tags) ? rail_slope : road_slope; }

}  // namespace

bool says_yes(const OsmTags& tags, const std::string& key) {
  const std::string& value = tag(tags, key);
  return !value.empty() && value != "no";
}

bool is_bridge(const OsmTags& tags) { return says_yes(tags, "bridge"); }

bool is_underground(const OsmTags& tags) {
  return (says_yes(tags, "tunnel") && tag(tags, "tunnel") != "building_passage") ||
         tag(tags, "location") == "underground";
}

OsmRelief::OsmRelief(const OsmFile& osm, const OsmPlaces& place) : osm_(osm), place_(place) {
  for (const OsmWay& way : osm.ways) {
    if (!is_bridge(way.tags) || !(is_road(way.tags) || is_rail(way.tags))) continue;
    const double above_m = height_of_bridge(way);
    for (const OsmId node : way.nodes) raise(node, above_m);
  }
  if (!above_m_.empty()) lead_down();
}

void OsmRelief::raise(OsmId node, double above_m) {
  double& known_m = above_m_[node];
  known_m = std::max(known_m, above_m);
}

/// Compared with every way that is not a bridge of the same layer or a higher one, segment by segment.
double OsmRelief::height_of_bridge(const OsmWay& bridge) const {
  const int layer = std::max(layer_of(bridge.tags), 1);
  std::vector<dvec2> points;
  for (const OsmId node : bridge.nodes)
    if (const auto point = place_(node)) points.push_back(*point);
  if (points.empty()) return low_bridge_m;
  dvec2 low = points[0], high = points[0];
  for (const dvec2& point : points) low = glm::min(low, point), high = glm::max(high, point);
  for (const OsmWay& way : osm_.ways) {
    const bool is_below = &way != &bridge && (is_road(way.tags) || is_rail(way.tags)) &&
                          !is_underground(way.tags) && layer_of(way.tags) < layer;
    if (!is_below) continue;
    for (std::size_t i = 0; i + 1 < way.nodes.size(); ++i) {
      const auto a = place_(way.nodes[i]), b = place_(way.nodes[i + 1]);
      if (!a || !b) continue;
      const dvec2 from = glm::min(*a, *b), to = glm::max(*a, *b);
      if (from.x > high.x || from.y > high.y || to.x < low.x || to.y < low.y) continue;
      for (std::size_t k = 0; k + 1 < points.size(); ++k)
        if (cross(points[k], points[k + 1], *a, *b)) return double(layer) * (clearance_m + deck_m);
    }
  }
  return low_bridge_m;
}

/// Dijkstra's algorithm from the bridges along all ways, heights falling with the distance.
void OsmRelief::lead_down() {
  struct Step {
    OsmId to;
    double fall_m;
  };
  std::unordered_map<OsmId, std::vector<Step>> steps;
  for (const OsmWay& way : osm_.ways) {
    if (!(is_road(way.tags) || is_rail(way.tags)) || is_underground(way.tags)) continue;
    for (std::size_t i = 0; i + 1 < way.nodes.size(); ++i) {
      const auto a = place_(way.nodes[i]), b = place_(way.nodes[i + 1]);
      if (!a || !b) continue;
      const double fall_m = slope_of(way.tags) * glm::distance(*a, *b);
      steps[way.nodes[i]].push_back({way.nodes[i + 1], fall_m});
      steps[way.nodes[i + 1]].push_back({way.nodes[i], fall_m});
    }
  }
  std::priority_queue<std::pair<double, OsmId>> highest;
  for (const auto& [node, above_m] : above_m_) highest.emplace(above_m, node);
  while (!highest.empty()) {
    const auto [above_m, node] = highest.top();
    highest.pop();
    if (above_m < above_m_[node]) continue;
    for (const Step& step : steps[node]) {
      const double there_m = above_m - step.fall_m;
      if (there_m <= 0.0 || there_m <= above_m_[step.to]) continue;
      above_m_[step.to] = there_m;
      highest.emplace(there_m, step.to);
    }
  }
}

std::vector<RaisedPoint> OsmRelief::profile(const OsmWay& way) const {
  std::vector<RaisedPoint> nodes;
  for (const OsmId node : way.nodes)
    if (const auto point = place_(node)) {
      const auto raised = above_m_.find(node);
      nodes.push_back({*point, raised == above_m_.end() ? 0.0 : raised->second});
    }
  if (is_bridge(way.tags)) return nodes;
  const double slope = slope_of(way.tags);
  std::vector<RaisedPoint> points;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    points.push_back(nodes[i]);
    if (i + 1 == nodes.size()) break;
    const RaisedPoint &a = nodes[i], &b = nodes[i + 1];
    const double length_m = glm::distance(a.place, b.place);
    const double down_m = a.above_m / slope, up_m = length_m - b.above_m / slope;
    const auto add = [&](double at_m, double above_m) {
      if (at_m > 0.5 && at_m < length_m - 0.5)
        points.push_back({glm::mix(a.place, b.place, at_m / length_m), above_m});
    };
    if (down_m <= up_m) {
      if (a.above_m > 0.0) add(down_m, 0.0);
      if (b.above_m > 0.0) add(up_m, 0.0);
    } else if (a.above_m > 0.0 && b.above_m > 0.0) {  // the two ramps meet above the ground
      const double valley_m = 0.5 * (length_m + (a.above_m - b.above_m) / slope);
      add(valley_m, a.above_m - slope * valley_m);
    }
  }
  return points;
}

}  // namespace parvis::scene
