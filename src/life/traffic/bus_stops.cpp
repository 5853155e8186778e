#include "life/traffic/bus_stops.h"

#include <algorithm>
#include <cctype>
#include <glm/gtc/matrix_transform.hpp>

#include "synthesis/round_mesh.h"

namespace parvis::traffic {
namespace {

constexpr float beside_lane_m = 8.0f, room_ahead_m = 3.0f, level_m = 3.0f;
constexpr float shortest_bus_m = 8.0f;
constexpr float platform_m = 2.2f;    // breadth of the pavement on which people wait
constexpr float first_door_m = 1.0f;  // behind the front bumper
constexpr float second_door = 0.58f;  // of the length behind it
constexpr float pole_m = 2.6f, pole_radius_m = 0.03f;

/// The place of a path nearest to a point, in plan.
float nearest_along(const scene::MeasuredPath& path, glm::vec2 point) {
  constexpr float step_m = 0.5f;
  float best_m = 0.0f, least = 1e9f;
  for (float at = 0.0f; at <= path.length(); at += step_m)
    if (const float away = glm::distance(glm::vec2(path.at(at)), point); away < least)
      least = away, best_m = at;
  return best_m;
}

}  // namespace

bool is_bus(const VehicleShape& shape) {
  std::string name = shape.model ? shape.model->name : std::string();
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return name.find("bus") != std::string::npos || shape.length_m() > shortest_bus_m;
}

std::optional<BusStop> bus_stop_at(std::span<const DrivingLane> lanes, const BusStopDemand& demand,
                                   float length_m) {
  std::optional<BusStop> best;
  float least = beside_lane_m;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const DrivingLane& lane = lanes[i];
    if (lane.is_shared || !lane.is_usable || lane.path.length() < length_m + room_ahead_m + 1.0f) continue;
    const float at = std::clamp(nearest_along(lane.path, glm::vec2(demand.position)), length_m + 1.0f,
                                lane.path.length() - room_ahead_m);
    const glm::vec3 on_lane = lane.path.at(at), to = demand.position - on_lane;
    const glm::vec2 along = glm::normalize(glm::vec2(lane.path.direction_at(at)));
    const float aside = to.x * along.y - to.y * along.x;  // to the right
    if (aside < 0.3f || std::abs(to.z) > level_m || glm::length(glm::vec2(to)) > least) continue;
    least = glm::length(glm::vec2(to));
    best = BusStop{int(i), at, demand.dwell_s, demand.position, along, {along.y, -along.x}};
  }
  return best;
}

std::optional<glm::vec2> kerbward_of(const scene::RoadGraph& roads, glm::vec3 position) {
  std::optional<glm::vec2> best;
  float least = beside_lane_m;
  for (const scene::Lane& lane : roads.lanes) {
    if (lane.crossing >= 0 || lane.points.size() < 2) continue;
    const scene::MeasuredPath path(lane.points);
    const float at = nearest_along(path, glm::vec2(position));
    const glm::vec3 to = position - path.at(at);
    const glm::vec2 along = glm::normalize(glm::vec2(path.direction_at(at)));
    const float aside = to.x * along.y - to.y * along.x;
    if (aside < 0.3f || std::abs(to.z) > level_m || glm::length(glm::vec2(to)) > least) continue;
    least = glm::length(glm::vec2(to)), best = glm::vec2(along.y, -along.x);
  }
  return best;
}

scene::TransitStop transit_stop(const BusStop& stop, const VehicleShape& bus) {
  const float length = bus.length_m();
  const auto on_edge = [&](float behind_front_m) {
    return stop.kerb - glm::vec3(behind_front_m * stop.along, 0.0f);
  };
  scene::TransitStop result;
  result.from = on_edge(length), result.to = on_edge(0.0f);
  result.away = stop.kerbward, result.breadth_m = platform_m;
  for (const float behind : {first_door_m, second_door * length}) result.doors.push_back(on_edge(behind));
  return result;
}

std::shared_ptr<const scene::Model> bus_stop_pole(glm::vec3 foot, glm::vec2 kerbward) {
  auto model = std::make_shared<scene::Model>();
  model->name = "bus stop";
  const auto material = [&](const char* name, glm::vec3 colour, float roughness) {
    scene::Material result;
    result.name = name, result.base_colour = colour, result.roughness = roughness;
    model->materials.push_back(std::move(result));
  };
  material("pole", {0.32f, 0.34f, 0.36f}, 0.45f), material("sign", {0.03f, 0.16f, 0.45f}, 0.5f),
      material("timetable", {0.78f, 0.77f, 0.72f}, 0.6f);
  const glm::vec3 x(-kerbward.y, kerbward.x, 0.0f), y(kerbward, 0.0f);
  const glm::mat4 world_from_pole{glm::vec4(x, 0), glm::vec4(y, 0), glm::vec4(0, 0, 1, 0),
                                  glm::vec4(foot, 1)};
  const auto add = [&](const Mesh& mesh, int number) {
    scene::Part part;
    part.object = model->materials[std::size_t(number)].name, part.material = number;
    append(part.mesh, mesh, world_from_pole);
    model->parts.push_back(std::move(part));
  };
  // The sign stands out over the pavement, across the street: drivers see its face.
  add(synthesis::tube({{{0, 0, 0}, pole_radius_m}, {{0, 0, pole_m}, pole_radius_m}}, 12), 0);
  add(synthesis::panelled_box({-0.014f, 0.03f, pole_m - 0.50f}, {0.014f, 0.47f, pole_m - 0.06f}, 0.5f), 1);
  for (const float side : {-0.0155f, 0.0155f})  // a bus: a pale field with windows below a band
    for (const auto& [low, high] : {std::pair(glm::vec2(0.09f, 0.20f), glm::vec2(0.41f, 0.23f)),
                                    {glm::vec2(0.09f, 0.33f), glm::vec2(0.41f, 0.36f)},
                                    {glm::vec2(0.09f, 0.23f), glm::vec2(0.12f, 0.33f)},
                                    {glm::vec2(0.20f, 0.23f), glm::vec2(0.22f, 0.33f)},
                                    {glm::vec2(0.29f, 0.23f), glm::vec2(0.31f, 0.33f)},
                                    {glm::vec2(0.38f, 0.23f), glm::vec2(0.41f, 0.33f)},
                                    {glm::vec2(0.14f, 0.14f), glm::vec2(0.20f, 0.20f)},
                                    {glm::vec2(0.30f, 0.14f), glm::vec2(0.36f, 0.20f)}})
      add(synthesis::panelled_box({std::min(side, 0.5f * side), low.x, pole_m - 0.54f + low.y},
                                  {std::max(side, 0.5f * side), high.x, pole_m - 0.54f + high.y}, 0.5f),
          2);
  add(synthesis::panelled_box({-0.21f, -0.045f, 1.05f}, {0.21f, -0.03f, 1.75f}, 0.5f), 0);
  add(synthesis::panelled_box({-0.18f, 0.030f, 1.10f}, {0.18f, 0.036f, 1.70f}, 0.5f), 2);
  return model;
}

}  // namespace parvis::traffic
