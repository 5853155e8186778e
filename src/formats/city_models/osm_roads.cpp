#include "formats/city_models/osm_roads.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <set>

#include "scene/roads/road_builder.h"

namespace parvis::scene {
namespace {

constexpr float m_s_per_km_h = 1.0f / 3.6f;
constexpr float layer_m = 5.0f;         // a bridge above what it crosses
constexpr float ground_step_m = 10.0f;  // between points of a road on uneven ground

struct Kind {
  const char* name;
  int lanes_each_way;
  float speed_km_h, lane_width_m;
};
/// What a way of each kind has where its tags do not say.
constexpr std::array<Kind, 9> kinds{{{"motorway", 2, 120, 3.5f},
                                     {"trunk", 1, 90, 3.5f},
                                     {"primary", 1, 50, 3.25f},
                                     {"secondary", 1, 50, 3.25f},
                                     {"tertiary", 1, 50, 3.0f},
                                     {"unclassified", 1, 50, 3.0f},
                                     {"residential", 1, 30, 3.0f},
                                     {"living_street", 1, 10, 2.75f},
                                     {"service", 1, 20, 2.75f}}};

const Kind* kind_of(const OsmWay& way) {
  std::string name = tag(way.tags, "highway");
  if (name.ends_with("_link")) name.resize(name.size() - 5);
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) { return name == kind.name; });
  const bool is_street = found != kinds.end() && tag(way.tags, "area") != "yes";
  return is_street && (tag(way.tags, "tunnel").empty() || tag(way.tags, "tunnel") == "no") ? &*found
                                                                                           : nullptr;
}

std::optional<double> number(const std::string& text) {
  double value = 0.0;
  if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc()) return std::nullopt;
  return value;
}

float speed_m_s(const OsmWay& way, const Kind& kind) {
  constexpr double km_per_mile = 1.609344;
  const std::string& written = tag(way.tags, "maxspeed");
  const double given = number(written).value_or(0.0) * (written.ends_with("mph") ? km_per_mile : 1.0);
  return (given >= 1.0 && given <= 300.0 ? float(given) : kind.speed_km_h) * m_s_per_km_h;
}

int layer_of(const OsmWay& way) {
  if (tag(way.tags, "bridge").empty() || tag(way.tags, "bridge") == "no") return 0;
  return std::clamp(int(number(tag(way.tags, "layer")).value_or(1.0)), 0, 5);
}

class Roads {
 public:
  Roads(const OsmFile& osm, const OsmPlaces& place, const GroundOnMap& ground,
        const std::filesystem::path& file, CityAssembly& city)
      : osm_(osm), place_(place), ground_(ground), file_(file), city_(city) {
    for (const OsmWay& way : osm.ways) {
      if (!kind_of(way)) continue;
      for (const OsmId node : way.nodes) {
        const auto [known, is_new] = layer_at_.try_emplace(node, layer_of(way));
        if (!is_new) known->second = std::min(known->second, layer_of(way));
      }
    }
  }

  std::vector<Road> read() {
    std::vector<Road> roads;
    for (const OsmWay& way : osm_.ways)
      if (const Kind* kind = kind_of(way))
        if (Road road = read(way, *kind); road.path.size() >= 2) roads.push_back(std::move(road));
    return roads;
  }

 private:
  Road read(const OsmWay& way, const Kind& kind) {
    Road road;
    road.name = fmt::format("way {}", way.id);
    road.where = {file_.string(), way.line, 0};
    for (const OsmId node : way.nodes) {
      if (const std::optional<glm::dvec2> point = place_(node))
        road.path.emplace_back(glm::vec2(*point), layer_m * float(layer_at_[node]));
      else
        city_.warn(fmt::format("{}: its node {} is not in the file; it is drawn without", road.name, node));
    }
    if (ground_) road.path = laid_on_ground(road.path);
    const std::string& one_way = tag(way.tags, "oneway");
    if (one_way == "-1") std::reverse(road.path.begin(), road.path.end());
    road.is_one_way = one_way == "yes" || one_way == "1" || one_way == "true" || one_way == "-1" ||
                      tag(way.tags, "junction") == "roundabout" ||
                      (one_way.empty() && std::string(kind.name) == "motorway");
    const double lanes = number(tag(way.tags, "lanes")).value_or(0.0);
    if (lanes >= 1.0 && lanes <= 16.0)
      road.lanes_each_way = std::clamp(int(lanes) / (road.is_one_way ? 1 : 2), 1, 8);
    else
      road.lanes_each_way = kind.lanes_each_way;
    road.lane_width_m = kind.lane_width_m;
    road.speed_limit = speed_m_s(way, kind);
    return road;
  }

  /// With points between its own, for the ground rises and falls between them.
  std::vector<glm::vec3> laid_on_ground(const std::vector<glm::vec3>& path) const {
    std::vector<glm::vec3> laid;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const glm::vec3 next = path[std::min(i + 1, path.size() - 1)];
      const int steps = std::max(1, int(std::ceil(glm::distance(path[i], next) / ground_step_m)));
      for (int step = 0; step < (i + 1 < path.size() ? steps : 1); ++step)
        laid.push_back(glm::mix(path[i], next, float(step) / float(steps)));
    }
    for (glm::vec3& point : laid) point.z += float(ground_(glm::dvec2(point)));
    return laid;
  }

  const OsmFile& osm_;
  const OsmPlaces& place_;
  const GroundOnMap& ground_;
  const std::filesystem::path& file_;
  CityAssembly& city_;
  std::unordered_map<OsmId, int> layer_at_;  ///< the lowest of the roads that meet there
};

/// Leaves out, and reports, the roads of which the road builder can make no lanes.
void leave_out_unbuildable(std::vector<Road>& roads, CityAssembly& city) {
  for (;;) {
    const Result<RoadGraph> graph = build_road_graph(roads);
    if (graph) return;
    std::set<int> lines;
    for (const Error& problem : graph.errors()) {
      lines.insert(problem.where.line);
      city.warn(fmt::format("line {}: {}; it is left out", problem.where.line, problem.message));
    }
    if (std::erase_if(roads, [&](const Road& road) { return lines.count(road.where.line) != 0; }) == 0)
      return;
  }
}

}  // namespace

std::vector<Road> osm_roads(const OsmFile& osm, const OsmPlaces& place, const GroundOnMap& ground,
                            const std::filesystem::path& file, CityAssembly& city) {
  std::vector<Road> roads = Roads(osm, place, ground, file, city).read();
  leave_out_unbuildable(roads, city);
  return roads;
}

}  // namespace parvis::scene
