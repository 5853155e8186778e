#include "land/roads/road_builder.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "land/roads/road_network.h"
#include "scene/data/path.h"

namespace parvis::scene {

namespace {

constexpr float kerb_radius_m = 5.0f;    // of the corners between streets: a car turns right on 6.5 m
constexpr float corner_radius_m = 7.0f;  // of the innermost lane's edge where a street bends
constexpr float widest_loop_m = 4.5f,
                tightest_loop_m = 3.5f;    // radius on which a car turns round at a dead end
constexpr float longest_cut_m = 60.0f;     // back from a crossing, however acute the angle
constexpr float longest_corner_m = 12.0f;  // of it, for rounding the kerb
constexpr float shortest_cut_m = 1.5f;
constexpr float max_street_fraction = 0.8f;     // that its two crossings may take
constexpr float straight_on = 0.785f;           // radians: turns up to 45 degrees are no turns
constexpr float arc_step = glm::radians(6.0f);  // of a loop's points

/// One end of a street, as its node sees it.
struct Arm {
  std::size_t street = 0;
  bool is_start = false;  ///< the street begins here
  int node = 0;
  glm::vec2 outward{0.0f};  ///< unit, away from the node
  float half_width_m = 0.0f;
  bool is_one_way = false;
  float cut_m = 0.0f;             ///< of the street, taken by the crossing
  std::vector<int> lanes_in;      ///< that arrive at the node, from the middle of the road outward
  std::vector<int> lanes_out;     ///< that leave it, likewise
  glm::vec3 inward_at_end{0.0f};  ///< of the centre line after the cut: unit, toward the node
};

Arm make_arm(std::size_t index, const Street& street, const Road& road, bool is_start) {
  Arm arm;
  arm.street = index;
  arm.is_start = is_start;
  arm.node = is_start ? street.start_node : street.end_node;
  arm.half_width_m = half_width_m(road);
  arm.is_one_way = road.is_one_way;

  // The direction that matters is the one just outside the crossing.
  const float length = street.path.length();
  const float look_m = std::min(arm.half_width_m + kerb_radius_m, 0.5f * length);
  const glm::vec3 from = street.path.at(is_start ? 0.0f : length);
  const glm::vec3 to = street.path.at(is_start ? look_m : length - look_m);
  arm.outward = glm::normalize(glm::vec2(to - from));
  return arm;
}

/// How far from the node two arms' kerbs, rounded, stay clear of one another.
float clear_m(const Arm& arm, const Arm& other) {
  const float cosine = std::clamp(glm::dot(arm.outward, other.outward), -1.0f, 1.0f);
  const float half_angle_tangent = std::sqrt((1.0f - cosine) / std::max(1.0f + cosine, 1e-6f));
  const float width = std::max(arm.half_width_m, other.half_width_m);
  const float slope = 1.0f / std::max(half_angle_tangent, 1e-3f);
  return width * slope + std::min(kerb_radius_m * slope, longest_corner_m);
}

/// How much of a dead end the loop takes in which a car turns round; nothing where a one-way road ends.
float loop_length_m(const Arm& arm) {
  if (arm.is_one_way) return 0.0f;
  const float radius = std::clamp(1.5f * arm.half_width_m, tightest_loop_m, widest_loop_m);
  const float sum = radius + std::min(0.5f * arm.half_width_m, radius);
  return radius + std::sqrt(4.0f * radius * radius - sum * sum);
}

/// The arms of each node.
std::vector<std::vector<Arm*>> by_node(std::vector<Arm>& arms, const RoadNetwork& network) {
  std::vector<std::vector<Arm*>> arms_of_node(std::size_t(network.node_count));
  for (Arm& arm : arms) arms_of_node[std::size_t(arm.node)].push_back(&arm);
  return arms_of_node;
}

void cut_back(std::vector<Arm>& arms, const RoadNetwork& network) {
  for (const std::vector<Arm*>& meeting : by_node(arms, network))
    for (Arm* arm : meeting) {
      for (const Arm* other : meeting)
        if (other != arm)
          arm->cut_m = std::max(arm->cut_m, std::clamp(clear_m(*arm, *other), shortest_cut_m, longest_cut_m));
      if (meeting.size() == 1) arm->cut_m = loop_length_m(*arm);
    }
  // Arms come in pairs, a street's start and its end: where they want more than there is, they share it.
  for (std::size_t i = 0; i < arms.size(); i += 2) {
    const float room_m = max_street_fraction * network.streets[i / 2].path.length();
    const float wanted_m = arms[i].cut_m + arms[i + 1].cut_m;
    if (wanted_m <= room_m) continue;
    arms[i].cut_m *= room_m / wanted_m;
    arms[i + 1].cut_m *= room_m / wanted_m;
  }
}

int add_lane(RoadGraph& graph, Path points, const Road& road) {
  graph.lanes.push_back({std::move(points), {}, road.lane_width_m, road.speed_limit, -1});
  return int(graph.lanes.size()) - 1;
}

/// The street's lanes between the cuts of its two arms.
void add_street_lanes(RoadGraph& graph, const Street& street, const Road& road, Arm& start, Arm& end) {
  const float length = street.path.length();
  const Path part = street.path.part(start.cut_m, length - end.cut_m);
  const float outermost_m = half_width_m(road) - 0.5f * road.lane_width_m;
  const Path centre = rounded(part, outermost_m + corner_radius_m);
  const Path reversed(centre.rbegin(), centre.rend());

  start.inward_at_end = glm::normalize(centre[0] - centre[1]);
  end.inward_at_end = glm::normalize(reversed[0] - reversed[1]);
  const int along = road.lanes_each_way, against = road.lanes_against();
  const float divider = 0.5f * float(against - along);  // lanes to the right of the middle
  const auto aside_m = [&](float lane, float side) {
    return (side * divider + lane + 0.5f) * road.lane_width_m;
  };
  for (int i = 0; i < along; ++i) {
    const int forward = add_lane(graph, parallel(centre, aside_m(float(i), 1.0f)), road);
    start.lanes_out.push_back(forward), end.lanes_in.push_back(forward);
  }
  for (int i = 0; i < against; ++i) {
    const int backward = add_lane(graph, parallel(reversed, aside_m(float(i), -1.0f)), road);
    end.lanes_out.push_back(backward), start.lanes_in.push_back(backward);
  }
}

glm::vec3 end_direction(const Lane& lane) {
  return glm::normalize(lane.points.back() - lane.points[lane.points.size() - 2]);
}
glm::vec3 start_direction(const Lane& lane) { return glm::normalize(lane.points[1] - lane.points[0]); }

void join(RoadGraph& graph, int from, int to, Path points, int crossing) {
  const Lane &a = graph.lanes[std::size_t(from)], &b = graph.lanes[std::size_t(to)];
  const int turn = int(graph.lanes.size());
  Lane lane{std::move(points),
            {to},
            std::min(a.width_m, b.width_m),
            std::min(a.speed_limit, b.speed_limit),
            crossing};
  graph.lanes[std::size_t(from)].next.push_back(turn);
  graph.lanes.push_back(std::move(lane));
}

void turn(RoadGraph& graph, int from, int to, int crossing) {
  const Lane &a = graph.lanes[std::size_t(from)], &b = graph.lanes[std::size_t(to)];
  join(graph, from, to,
       turning_curve(a.points.back(), end_direction(a), b.points.front(), start_direction(b)), crossing);
}

/// The way round at the end of a street, `aside_m` being the distance of its lanes from their middle: a swing
/// to the right, a wide circle to the left, a swing to the right. `depth_m` is what there is before the
/// street's end.
Path loop(const Arm& arm, glm::vec3 middle, float aside_m, float depth_m) {
  const float over = depth_m - aside_m;
  const float fitting =
      0.5f * (std::sqrt(over * over + 2.0f * (depth_m * depth_m + aside_m * aside_m)) - over);
  const float radius = std::max(fitting, aside_m);
  const float swing = std::acos(std::min((aside_m + radius) / (2.0f * radius), 1.0f));
  const glm::vec3 ahead = arm.inward_at_end, left = -right_of(ahead);

  Path points;
  const auto append_arc = [&](glm::vec2 centre, float from, float to) {
    const int steps = std::max(1, int(std::ceil(std::abs(to - from) / arc_step)));
    for (int i = 0; i <= steps; ++i) {
      const float angle = glm::mix(from, to, float(i) / float(steps));
      const glm::vec2 p = centre + radius * glm::vec2(std::cos(angle), std::sin(angle));
      points.push_back(middle + ahead * p.x + left * p.y);
    }
  };
  constexpr float right_angle = glm::half_pi<float>();
  append_arc({0.0f, -aside_m - radius}, right_angle, right_angle - swing);
  append_arc({2.0f * radius * std::sin(swing), 0.0f}, -right_angle - swing, right_angle + swing);
  append_arc({0.0f, aside_m + radius}, -right_angle + swing, -right_angle);
  return without_repeats(points);
}

void add_way_round(RoadGraph& graph, const Arm& arm, int crossing) {
  for (std::size_t i = 0; i < arm.lanes_in.size(); ++i) {
    const int in = arm.lanes_in[i], out = arm.lanes_out[std::min(i, arm.lanes_out.size() - 1)];
    const glm::vec3 start = graph.lanes[std::size_t(in)].points.back(),
                    end = graph.lanes[std::size_t(out)].points.front();
    const float aside_m = 0.5f * glm::distance(glm::vec2(start), glm::vec2(end));
    join(graph, in, out, loop(arm, 0.5f * (start + end), aside_m, arm.cut_m), crossing);
  }
}

/// Straight on, lane by lane; to the right from the outermost lane, to the left from the innermost.
void add_turns_between(RoadGraph& graph, const Arm& from, const Arm& to, int crossing) {
  const std::size_t in = from.lanes_in.size(), out = to.lanes_out.size();
  if (in == 0 || out == 0) return;
  const glm::vec2 ahead = -from.outward;
  const float angle =
      std::atan2(ahead.x * to.outward.y - ahead.y * to.outward.x, glm::dot(ahead, to.outward));
  if (angle > straight_on) return turn(graph, from.lanes_in.front(), to.lanes_out.front(), crossing);
  if (angle < -straight_on) return turn(graph, from.lanes_in.back(), to.lanes_out.back(), crossing);
  for (std::size_t i = 0; i < std::min(in, out); ++i)
    turn(graph, from.lanes_in[i], to.lanes_out[i], crossing);
}

/// Lanes that no rule has served yet (the middle lane before a T) turn into the nearest way out.
void serve_forgotten_lanes(RoadGraph& graph, const Arm& from, std::span<Arm* const> arms, int crossing) {
  const Arm* best = nullptr;
  for (const Arm* to : arms)
    if (to != &from && !to->lanes_out.empty() &&
        (best == nullptr || glm::dot(from.outward, to->outward) < glm::dot(from.outward, best->outward)))
      best = to;
  if (best == nullptr) return from.is_one_way ? void() : add_way_round(graph, from, crossing);
  for (std::size_t i = 0; i < from.lanes_in.size(); ++i)
    if (graph.lanes[std::size_t(from.lanes_in[i])].next.empty())
      turn(graph, from.lanes_in[i], best->lanes_out[std::min(i, best->lanes_out.size() - 1)], crossing);
}

void add_crossing(RoadGraph& graph, std::span<Arm* const> arms, int crossing) {
  for (const Arm* from : arms)
    for (const Arm* to : arms)
      if (from != to) add_turns_between(graph, *from, *to, crossing);
  for (const Arm* from : arms) serve_forgotten_lanes(graph, *from, arms, crossing);
}

}  // namespace

Result<RoadGraph> build_road_graph(std::span<const Road> roads, std::size_t max_complaints) {
  const Result<RoadNetwork> network = connect_roads(roads, max_complaints);
  if (!network) return network.errors();

  std::vector<Arm> arms;
  for (std::size_t i = 0; i < network->streets.size(); ++i) {
    const Street& street = network->streets[i];
    arms.push_back(make_arm(i, street, roads[street.road], true));
    arms.push_back(make_arm(i, street, roads[street.road], false));
  }
  cut_back(arms, *network);

  RoadGraph graph;
  for (std::size_t i = 0; i < network->streets.size(); ++i) {
    const Street& street = network->streets[i];
    add_street_lanes(graph, street, roads[street.road], arms[2 * i], arms[2 * i + 1]);
  }

  const std::vector<std::vector<Arm*>> arms_of_node = by_node(arms, *network);
  for (std::size_t node = 0; node < arms_of_node.size(); ++node)
    add_crossing(graph, arms_of_node[node], int(node));
  return graph;
}

}  // namespace parvis::scene
