#include "formats/city_models/osm_roads.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <set>

#include "formats/city_models/osm_measures.h"
#include "land/roads/road_builder.h"

namespace parvis::scene {
namespace {

constexpr float m_s_per_km_h = 1.0f / 3.6f;
constexpr double narrowest_lane_m = 1.5, widest_lane_m = 6.0;
constexpr float aisle_speed_km_h = 15.0f;  // in car parks, driveways, alleys
constexpr float ground_step_m = 10.0f;     // between points of a road on uneven ground

struct RoadKind {
  const char* name;
  int lanes_each_way;
  float speed_km_h, lane_width_m;
};
/// Defaults of each kind of way where its tags do not say.
constexpr std::array<RoadKind, 9> road_kinds{{{"motorway", 2, 120, 3.5f},
                                              {"trunk", 1, 90, 3.5f},
                                              {"primary", 1, 50, 3.25f},
                                              {"secondary", 1, 50, 3.25f},
                                              {"tertiary", 1, 50, 3.0f},
                                              {"unclassified", 1, 50, 3.0f},
                                              {"residential", 1, 30, 3.0f},
                                              {"living_street", 1, 10, 2.75f},
                                              {"service", 1, 20, 2.75f}}};

const RoadKind* kind_of(const OsmTags& tags) {
  std::string name = tag(tags, "highway");
  if (name.ends_with("_link")) name.resize(name.size() - 5);
  const auto found = std::find_if(road_kinds.begin(), road_kinds.end(),
                                  [&](const RoadKind& kind) { return name == kind.name; });
  return found != road_kinds.end() && tag(tags, "area") != "yes" ? &*found : nullptr;
}

float speed_m_s(const OsmWay& way, const RoadKind& kind) {
  constexpr double km_per_mile = 1.609344;
  const std::string& written = tag(way.tags, "maxspeed");
  double given = 0.0;
  std::from_chars(written.data(), written.data() + written.size(), given);
  if (written.ends_with("mph")) given *= km_per_mile;
  const float km_h = given >= 1.0 && given <= 300.0 ? float(given) : kind.speed_km_h;
  const bool is_aisle = !tag(way.tags, "service").empty();
  return (is_aisle ? std::min(km_h, aisle_speed_km_h) : km_h) * m_s_per_km_h;
}

bool is_one_way(const OsmWay& way, const RoadKind& kind) {
  const std::string& one_way = tag(way.tags, "oneway");
  return one_way == "yes" || one_way == "1" || one_way == "true" || one_way == "-1" ||
         tag(way.tags, "junction") == "roundabout" ||
         (one_way.empty() && std::string(kind.name) == "motorway");
}

struct Lanes {
  int along, against;
};

/// Lanes of each direction. Of an odd number without directions the one in the middle runs along the way, as
/// does one that lanes:both_ways shares; a single lane is shared by cars of both directions.
Lanes lanes_of(const OsmWay& way, const RoadKind& kind) {
  constexpr int max_lanes = 16, max_each_way = 8;
  const auto count = [&](const char* key) {
    const double given = number_in(tag(way.tags, key)).value_or(0.0);
    return given >= 1.0 && given <= max_lanes ? int(given) : 0;
  };
  const int all = count("lanes"), forward = count("lanes:forward") + count("lanes:both_ways"),
            backward = count("lanes:backward");
  if (is_one_way(way, kind)) {
    const int given = all > 0 ? all : std::max(forward, backward);
    return {given > 0 ? std::min(given, max_each_way) : kind.lanes_each_way, 0};
  }
  Lanes lanes{forward, backward};
  if (lanes.along == 0 && lanes.against == 0 && all == 0) return {kind.lanes_each_way, kind.lanes_each_way};
  if (lanes.along == 0 && lanes.against == 0) lanes.against = all / 2;
  if (lanes.along == 0) lanes.along = all > 0 ? all - lanes.against : kind.lanes_each_way;
  if (lanes.against == 0) lanes.against = all > 0 ? all - lanes.along : kind.lanes_each_way;
  return {std::clamp(lanes.along, 1, max_each_way), std::clamp(lanes.against, 1, max_each_way)};
}

/// The lane's part of the width that is given, else the usual width; a single lane for both directions is
/// shared.
float lane_width_m(const OsmWay& way, const RoadKind& kind) {
  const Lanes lanes = lanes_of(way, kind);
  const double given_m = metres_in(tag(way.tags, "width")).value_or(0.0) / (lanes.along + lanes.against);
  if (given_m >= narrowest_lane_m && given_m <= widest_lane_m) return float(given_m);
  const std::string& service = tag(way.tags, "service");
  if (service == "driveway" || service == "alley" || tag(way.tags, "lanes") == "1")
    return is_one_way(way, kind) ? kind.lane_width_m : 0.6f * kind.lane_width_m;
  return kind.lane_width_m;
}

class Roads {
 public:
  Roads(const OsmFile& osm, const OsmPlaces& place, const OsmRelief& relief, const GroundOnMap& ground,
        const glm::dvec3& origin, const std::filesystem::path& file, CityAssembly& city)
      : osm_(osm),
        place_(place),
        relief_(relief),
        ground_(ground),
        origin_(origin),
        file_(file),
        city_(city) {}

  std::vector<Road> read() {
    std::vector<Road> roads;
    for (const OsmWay& way : osm_.ways)
      if (const RoadKind* kind = kind_of(way.tags); kind && !is_left_out(way.tags))
        if (Road road = read(way, *kind); road.path.size() >= 2) roads.push_back(std::move(road));
    return roads;
  }

 private:
  bool is_left_out(const OsmTags& tags) const {
    return is_underground(tags) && (bool(ground_) || !is_tunnel(tags));
  }

  Road read(const OsmWay& way, const RoadKind& kind) {
    Road road;
    road.name = fmt::format("way {}", way.id);
    road.where = {file_.string(), 0, 0};
    for (const OsmId node : way.nodes)
      if (!place_(node))
        city_.warn(fmt::format("{}: its node {} is not in the file; it is drawn without", road.name, node));
    for (const RaisedPoint& point : relief_.profile(way))
      road.path.emplace_back(glm::vec2(point.place - glm::dvec2(origin_)), float(point.above_m));
    if (ground_) road.path = laid_on_ground(road.path);
    if (tag(way.tags, "oneway") == "-1") std::reverse(road.path.begin(), road.path.end());
    road.is_one_way = is_one_way(way, kind);
    const Lanes lanes = lanes_of(way, kind);
    road.lanes_each_way = lanes.along;
    road.lanes_back = lanes.against == lanes.along ? 0 : lanes.against;
    road.lane_width_m = lane_width_m(way, kind);
    road.speed_limit = speed_m_s(way, kind);
    return road;
  }

  /// The path with points between its own, for the ground rises and falls between them.
  std::vector<glm::vec3> laid_on_ground(const std::vector<glm::vec3>& path) const {
    std::vector<glm::vec3> laid;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const glm::vec3 next = path[std::min(i + 1, path.size() - 1)];
      const int steps = std::max(1, int(std::ceil(glm::distance(path[i], next) / ground_step_m)));
      for (int step = 0; step < (i + 1 < path.size() ? steps : 1); ++step)
        laid.push_back(glm::mix(path[i], next, float(step) / float(steps)));
    }
    for (glm::vec3& point : laid) point.z += float(ground_(glm::dvec2(point) + glm::dvec2(origin_)));
    return laid;
  }

  const OsmFile& osm_;
  const OsmPlaces& place_;
  const OsmRelief& relief_;
  const GroundOnMap& ground_;
  const glm::dvec3& origin_;
  const std::filesystem::path& file_;
  CityAssembly& city_;
};

/// Leaves out, and reports, the roads of which the road builder can make no lanes. A round finds all that are
/// wrong by themselves; what it finds of the network as a whole, it blames on one road. Where that does not
/// end soon, all roads are left out.
void leave_out_unbuildable(std::vector<Road>& roads, CityAssembly& city) {
  constexpr int max_rounds = 16;
  for (int round = 1;; ++round) {
    for (std::size_t i = 0; i < roads.size(); ++i)
      roads[i].where.line = int(i) + 1;  // by which errors name them
    // all that are wrong at once: as many graphs as roads, built one after the other, would take cubic time
    const Result<RoadGraph> graph = build_road_graph(roads, roads.size() + 1);
    if (!graph && round > max_rounds) {
      city.warn(fmt::format("{}; its streets are left out: cut out the part of the map that you need",
                            graph.errors().front().message));
      roads.clear();
      return;
    }
    std::set<int> numbers;
    if (!graph)
      for (const Error& problem : graph.errors()) {
        numbers.insert(problem.where.line);
        const std::size_t index = std::size_t(std::max(problem.where.line, 1)) - 1;
        city.warn(fmt::format("{}: {}; it is left out", index < roads.size() ? roads[index].name : "a road",
                              problem.message));
      }
    if (std::erase_if(roads, [&](const Road& road) { return numbers.count(road.where.line) != 0; }) == 0)
      break;
  }
  for (Road& road : roads) road.where.line = 0;
}

}  // namespace

bool is_street(const OsmTags& tags) { return kind_of(tags) != nullptr; }

double half_carriageway_m(const OsmWay& way) {
  const RoadKind* kind = kind_of(way.tags);
  if (!kind) return 0.0;
  const Lanes lanes = lanes_of(way, *kind);
  return 0.5 * double(lane_width_m(way, *kind)) * (lanes.along + lanes.against);
}

std::vector<Road> osm_roads(const OsmFile& osm, const OsmPlaces& place, const OsmRelief& relief,
                            const GroundOnMap& ground, const glm::dvec3& origin,
                            const std::filesystem::path& file, CityAssembly& city) {
  std::vector<Road> roads = Roads(osm, place, relief, ground, origin, file, city).read();
  leave_out_unbuildable(roads, city);
  return roads;
}

}  // namespace parvis::scene
