#include "land/roads/road_network.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "land/roads/segment_finder.h"

namespace parvis::scene {

namespace {

constexpr float bridge_clearance_m = 3.0f;  // roads further apart than this in height pass over one another
constexpr float shortest_street_m = 2.0f;   // what must remain between two crossings for both to stand
constexpr int max_lanes_each_way = 8;
constexpr std::size_t max_arms = 64;  // of a crossing: lanes from each of them lead into each
constexpr std::size_t max_streets = 200'000;
constexpr std::size_t max_meetings = 5'000'000;  // of two roads; where many end in one place each meets each
constexpr double max_lanes_km = 20'000.0;        // of all lanes: a capital has a third of it
constexpr float parallel_sine = 0.05f;           // 3 degrees

/// A straight piece of a road.
struct Segment {
  std::size_t road;
  std::size_t index;
  glm::vec3 a, b;
  float start_m;  ///< arc length of the road at `a`
  bool is_first, is_last;
  float length() const { return glm::distance(a, b); }
};

/// A place on a road where something happens: an end, or a meeting with another road.
struct Spot {
  std::size_t road;
  float distance;
  float
      reach;  ///< how far the meeting extends along the road: half the width of what it meets, 0 at free ends
};

/// Spots, and which of them are one node (a union-find forest).
struct Spots {
  std::vector<Spot> spots;
  std::vector<std::size_t> parents;

  std::size_t add(const Spot& spot) {
    spots.push_back(spot);
    parents.push_back(parents.size());
    return parents.size() - 1;
  }
  /// Halves the path on its way, so that long chains are walked once.
  std::size_t root(std::size_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
  }
  void unite(std::size_t a, std::size_t b) {
    parents[std::max(root(a), root(b))] = std::min(root(a), root(b));
  }
};

std::string name_of(const Road& road, std::size_t index) {
  return road.name.empty() ? fmt::format("road {}", index + 1) : fmt::format("road \"{}\"", road.name);
}

std::optional<Error> fault_of(const Road& road, std::size_t index) {
  const std::string name = name_of(road, index);
  for (const glm::vec3& p : road.path)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      return error_at(road.where, "{}: its path holds a number that is not finite", name);
  for (const int lanes : {road.lanes_each_way, road.lanes_back > 0 ? road.lanes_back : road.lanes_each_way})
    if (lanes < 1 || lanes > max_lanes_each_way)
      return error_at(road.where, "{}: expected 1 to {} lanes, got {}", name, max_lanes_each_way, lanes);
  if (!(road.lane_width_m > 0.0f) || !std::isfinite(road.lane_width_m))
    return error_at(road.where, "{}: expected a lane width above 0 m, got {}", name, road.lane_width_m);
  if (!(road.speed_limit > 0.0f) || !std::isfinite(road.speed_limit))
    return error_at(road.where, "{}: expected a speed limit above 0 m/s, got {}", name, road.speed_limit);

  const Path path = without_repeats(road.path);
  if (path.size() < 2)
    return error_at(road.where, "{}: expected a path of at least two different points, got {}", name,
                    path.size());
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const glm::vec2 in = glm::normalize(glm::vec2(path[i] - path[i - 1]));
    const glm::vec2 out = glm::normalize(glm::vec2(path[i + 1] - path[i]));
    if (glm::dot(in, out) < -0.999f)
      return error_at(road.where, "{}: turns back on itself at point {}; end the road there instead", name,
                      i + 1);
  }
  return std::nullopt;
}

std::vector<Segment> segments_of(std::span<const MeasuredPath> paths) {
  std::vector<Segment> segments;
  for (std::size_t road = 0; road < paths.size(); ++road) {
    const Path& points = paths[road].points();
    float start_m = 0.0f;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      segments.push_back({road, i, points[i], points[i + 1], start_m, i == 0, i + 2 == points.size()});
      start_m += segments.back().length();
    }
  }
  return segments;
}

/// Whether the segments run side by side so closely, for so long, that their lanes would be the same.
bool coincide(const Segment& s, const Segment& t, const Road& road_s, const Road& road_t) {
  const glm::vec2 a(s.a), d = glm::normalize(glm::vec2(s.b - s.a)), e = glm::normalize(glm::vec2(t.b - t.a));
  if (std::abs(d.x * e.y - d.y * e.x) > parallel_sine) return false;
  const float length = glm::distance(glm::vec2(s.a), glm::vec2(s.b));
  const float t0 = glm::dot(glm::vec2(t.a) - a, d), t1 = glm::dot(glm::vec2(t.b) - a, d);
  const float from = std::max(0.0f, std::min(t0, t1)), to = std::min(length, std::max(t0, t1));
  if (to - from < 2.0f + half_width_m(road_s) + half_width_m(road_t)) return false;
  const glm::vec2 normal(-d.y, d.x);
  const float near = 0.5f * std::min(road_s.lane_width_m, road_t.lane_width_m);
  const auto aside = [&](float along) {
    const glm::vec3 p = glm::mix(t.a, t.b, (along - t0) / (t1 - t0));
    return std::abs(glm::dot(glm::vec2(p) - a, normal));
  };
  const bool is_bridge = std::abs(s.a.z + s.b.z - t.a.z - t.b.z) > 2.0f * bridge_clearance_m;
  return aside(from) < near && aside(to) < near && !is_bridge;
}

/// Looks at every pair of segments that come near one another. A road that lies along an earlier one is not
/// looked at again: of many roads in one place, all pairs would take too long.
class Meetings {
 public:
  Meetings(std::span<const Road> roads, std::span<const MeasuredPath> paths, std::size_t max_complaints)
      : roads_(roads), paths_(paths), max_complaints_(max_complaints), lies_along_(roads.size()) {}

  Result<Spots> find() {
    for (std::size_t road = 0; road < paths_.size(); ++road) {
      result_.add({road, 0.0f, 0.0f});
      result_.add({road, paths_[road].length(), 0.0f});
    }
    std::vector<Segment> segments = segments_of(paths_);
    std::ranges::sort(segments, {}, [](const Segment& s) {
      return std::tuple(std::min(s.a.x, s.b.x), s.road, s.index);  // from the west
    });
    std::vector<PlanBox> boxes;
    boxes.reserve(segments.size());
    for (const Segment& s : segments)
      boxes.push_back({glm::min(glm::vec2(s.a), glm::vec2(s.b)), glm::max(glm::vec2(s.a), glm::vec2(s.b))});
    const SegmentFinder finder(boxes);
    const float widest = widest_m();
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const Segment& s = segments[i];
      if (lies_along_[s.road]) continue;
      finder.find({boxes[i].min - widest, boxes[i].max + widest}, i, near);
      for (const std::size_t j : near) {
        if (lies_along_[s.road]) break;
        if (meetings_ > max_meetings)
          return error_at(
              roads_[s.road].where,
              "{} is one of so many in one place that they meet more than {} times; leave some out",
              name_of(roads_[s.road], s.road), max_meetings);
        const Segment& t = segments[j];
        if (!lies_along_[t.road] && comes_near(boxes[i], boxes[j], snap_m(s, t))) look_at(s, t);
      }
    }
    if (!errors_.empty()) return std::move(errors_);
    return std::move(result_);
  }

 private:
  /// Compares the boxes from north to south; the finder has compared them from east to west.
  static bool comes_near(const PlanBox& a, const PlanBox& b, float reach_m) {
    return a.min.y - reach_m <= b.max.y && b.min.y - reach_m <= a.max.y;
  }
  float snap_m(const Segment& s, const Segment& t) const {
    return std::max(half_width_m(roads_[s.road]), half_width_m(roads_[t.road]));
  }
  float widest_m() const {
    float widest = 0.0f;
    for (const Road& road : roads_) widest = std::max(widest, half_width_m(road));
    return widest;
  }

  void look_at(const Segment& s, const Segment& t) {
    const bool is_neighbour = s.road == t.road && (s.index + 1 == t.index || t.index + 1 == s.index);
    if (is_neighbour) return;
    if (coincide(s, t, roads_[s.road], roads_[t.road])) return complain(s, t);
    meet_where_they_cross(s, t);
    if (s.is_first) meet_at_end(s.road, 0.0f, s.a, t);
    if (s.is_last) meet_at_end(s.road, paths_[s.road].length(), s.b, t);
    if (t.is_first) meet_at_end(t.road, 0.0f, t.a, s);
    if (t.is_last) meet_at_end(t.road, paths_[t.road].length(), t.b, s);
  }

  void complain(const Segment& s, const Segment& t) {
    const std::size_t later = std::max(s.road, t.road), earlier = std::min(s.road, t.road);
    lies_along_[later] = true;
    if (++complaints_ > max_complaints_) return;
    if (complaints_ == max_complaints_)
      return errors_.push_back(error_at(roads_[later].where, "more roads lie along others"));
    errors_.push_back(error_at(
        roads_[later].where, "{} lies along {}: give one of them another path, or remove it",
        name_of(roads_[later], later), earlier == later ? "itself" : name_of(roads_[earlier], earlier)));
  }

  void meet_where_they_cross(const Segment& s, const Segment& t) {
    const glm::vec3 d = s.b - s.a, e = t.b - t.a;
    const float cross = cross_in_plan(d, e);
    if (std::abs(cross) < 1e-6f * glm::length(d) * glm::length(e)) return;
    const float along_s = cross_in_plan(t.a - s.a, e) / cross;
    const float along_t = cross_in_plan(t.a - s.a, d) / cross;
    if (along_s < 0.0f || along_s > 1.0f || along_t < 0.0f || along_t > 1.0f) return;
    if (std::abs((s.a + d * along_s).z - (t.a + e * along_t).z) > bridge_clearance_m) return;
    meet(s.road, s.start_m + along_s * s.length(), t.road, t.start_m + along_t * t.length());
  }

  /// The end of `road` at `distance` meets segment `t` where it lies on the road's surface there, or beside
  /// its end.
  void meet_at_end(std::size_t road, float distance, glm::vec3 end, const Segment& t) {
    const glm::vec2 d(t.b - t.a);
    const float along = std::clamp(glm::dot(glm::vec2(end - t.a), d) / glm::dot(d, d), 0.0f, 1.0f);
    const glm::vec3 nearest = glm::mix(t.a, t.b, along);
    const bool is_end = (along == 0.0f && t.is_first) || (along == 1.0f && t.is_last);
    const float other_half_m = half_width_m(roads_[t.road]);
    const float snap = is_end ? std::max(other_half_m, half_width_m(roads_[road])) : other_half_m;
    const float other_distance = t.start_m + along * t.length();
    if (glm::distance(glm::vec2(end), glm::vec2(nearest)) > snap) return;
    if (std::abs(end.z - nearest.z) > bridge_clearance_m) return;
    if (road == t.road && std::abs(distance - other_distance) < 4.0f * other_half_m) return;
    meet(road, distance, t.road, other_distance);
  }

  void meet(std::size_t road_a, float distance_a, std::size_t road_b, float distance_b) {
    const std::size_t a = result_.add({road_a, distance_a, half_width_m(roads_[road_b])});
    const std::size_t b = result_.add({road_b, distance_b, half_width_m(roads_[road_a])});
    result_.unite(a, b);
    ++meetings_;
  }

  std::span<const Road> roads_;
  std::span<const MeasuredPath> paths_;
  Spots result_;
  Errors errors_;
  std::size_t max_complaints_, complaints_ = 0, meetings_ = 0;
  std::vector<bool> lies_along_;  ///< by road: along an earlier one
};

/// Cuts one road at its spots (indices in order along it); what lies between two that are too close is
/// crossing.
void cut_road(const MeasuredPath& path, std::span<const std::size_t> in_order, Spots& spots,
              std::vector<std::pair<std::size_t, std::size_t>>& cuts) {
  for (std::size_t i = 0; i + 1 < in_order.size(); ++i) {
    const Spot& from = spots.spots[in_order[i]];
    const Spot& to = spots.spots[in_order[i + 1]];
    const float reach = from.reach + to.reach;
    const float gap = to.distance - from.distance;
    const bool is_whole_road = from.reach == 0.0f && to.reach == 0.0f && gap >= path.length() - 1e-3f;
    if (gap < reach + shortest_street_m && !is_whole_road)
      spots.unite(in_order[i], in_order[i + 1]);
    else
      cuts.emplace_back(in_order[i], in_order[i + 1]);
  }
}

/// Refuses what no town has, and what would make more turns than there is memory for.
Status check_size(const RoadNetwork& network, std::span<const Road> roads, std::size_t max_complaints) {
  if (network.streets.size() > max_streets)
    return error_at(roads.front().where, "the roads cut each other into {} streets; expected {} at most",
                    network.streets.size(), max_streets);
  double lanes_km = 0.0;
  for (const Street& street : network.streets)
    lanes_km += 1e-3 * double(street.path.length()) *
                double(roads[street.road].lanes_each_way + roads[street.road].lanes_against());
  if (!(lanes_km <= max_lanes_km))
    return error_at(roads.front().where, "the roads have {:.0f} km of lanes; expected {:.0f} km at most",
                    lanes_km, max_lanes_km);
  std::vector<std::size_t> arms(std::size_t(network.node_count), 0);
  std::set<std::size_t> crowding;  // roads
  for (const Street& street : network.streets)
    for (const int node : {street.start_node, street.end_node})
      if (++arms[std::size_t(node)] > max_arms && crowding.size() < max_complaints)
        crowding.insert(street.road);
  Errors errors;
  for (const std::size_t road : crowding)
    errors.push_back(error_at(
        roads[road].where,
        "{} meets so many others at one place that more than {} streets lead away from it, too many for "
        "a crossing; leave some out",
        name_of(roads[road], road), max_arms));
  if (!errors.empty()) return errors;
  return Ok{};
}

}  // namespace

float half_width_m(const Road& road) {
  return 0.5f * road.lane_width_m * float(road.lanes_each_way + road.lanes_against());
}

Result<RoadNetwork> connect_roads(std::span<const Road> roads, std::size_t max_complaints) {
  Errors errors;
  std::vector<MeasuredPath> paths;
  for (std::size_t i = 0; i < roads.size(); ++i) {
    if (std::optional<Error> fault = fault_of(roads[i], i))
      errors.push_back(std::move(*fault));
    else
      paths.emplace_back(without_repeats(roads[i].path));
  }
  if (!errors.empty()) return errors;

  Result<Spots> found = Meetings(roads, paths, max_complaints).find();
  if (!found) return found.errors();
  Spots& spots = *found;

  std::vector<std::vector<std::size_t>> spots_of_road(roads.size());
  for (std::size_t i = 0; i < spots.spots.size(); ++i) spots_of_road[spots.spots[i].road].push_back(i);
  std::vector<std::pair<std::size_t, std::size_t>> cuts;
  for (std::size_t road = 0; road < roads.size(); ++road) {
    std::ranges::sort(spots_of_road[road], {},
                      [&](std::size_t i) { return std::pair(spots.spots[i].distance, i); });
    cut_road(paths[road], spots_of_road[road], spots, cuts);
  }

  RoadNetwork network;
  std::map<std::size_t, int> nodes;
  const auto node_of = [&](std::size_t spot) {
    return nodes.try_emplace(spots.root(spot), int(nodes.size())).first->second;
  };
  for (const auto& [from, to] : cuts) {
    const Spot &start = spots.spots[from], &end = spots.spots[to];
    const int start_node = node_of(from), end_node = node_of(to);
    network.streets.push_back({MeasuredPath(paths[start.road].part(start.distance, end.distance)), start.road,
                               start_node, end_node});
  }
  network.node_count = int(nodes.size());
  if (Status status = check_size(network, roads, max_complaints); !status) return status.errors();
  return network;
}

}  // namespace parvis::scene
