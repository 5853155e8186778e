#include "life/traffic/traffic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "land/roads/road_builder.h"
#include "life/traffic/street_ends.h"
#include "life/traffic/test_cars.h"
#include "life/traffic/traffic_process.h"
#include "scene/action/scene_clock.h"
#include "scene/data/path.h"

namespace parvis::traffic {
namespace {

scene::Road road(std::vector<glm::vec3> path, int lanes = 1) {
  scene::Road result;
  result.path = std::move(path);
  result.lanes_each_way = lanes;
  return result;
}

scene::Scene scene_of(const std::vector<scene::Road>& roads, int vehicles) {
  scene::Scene scene;
  Result<scene::RoadGraph> graph = scene::build_road_graph(roads);
  EXPECT_TRUE(graph.ok());
  scene.roads = std::move(*graph);
  scene.data<TrafficDemand>() = {vehicles, 7, {test_car(4.4f, 1.8f), test_car(5.4f, 2.0f)}};
  return scene;
}

/// `count` streets each way, `spacing_m` apart; their ends stick out as dead ends.
std::vector<scene::Road> grid(int count, float spacing_m, int lanes = 1) {
  std::vector<scene::Road> roads;
  const float length = spacing_m * float(count + 1);
  for (int i = 1; i <= count; ++i) {
    roads.push_back(road({{0, spacing_m * float(i), 0}, {length, spacing_m * float(i), 0}}, lanes));
    roads.push_back(road({{spacing_m * float(i), 0, 0}, {spacing_m * float(i), length, 0}}, lanes));
  }
  return roads;
}

/// Lets so many seconds pass.
void pass(Traffic& traffic, float seconds) {
  for (long steps = std::lround(seconds / step_s); steps > 0; --steps) traffic.step();
}

/// Pairs of vehicles that overlap at this moment.
int overlaps(const Simulation& simulation) {
  std::vector<Footprint> footprints;
  for (const Vehicle& vehicle : simulation.vehicles())
    footprints.push_back(vehicle.footprint(0.0f, simulation.lanes()));
  int count = 0;
  for (std::size_t i = 0; i < footprints.size(); ++i)
    for (std::size_t j = i + 1; j < footprints.size(); ++j) count += overlap(footprints[i], footprints[j]);
  return count;
}

/// Five minutes without a collision, a stranded vehicle, or one that leaves its way.
void expect_orderly_traffic(const scene::Scene& scene) {
  Traffic traffic(scene);
  const Simulation& simulation = traffic.simulation();
  ASSERT_GT(traffic.vehicle_count(), 0u);
  std::vector<double> travelled_at_start;
  for (const Vehicle& v : simulation.vehicles()) travelled_at_start.push_back(v.travelled_m);
  for (int tenth = 0; tenth < 3000; ++tenth) {
    pass(traffic, 0.1f);
    ASSERT_EQ(overlaps(simulation), 0) << "after " << 0.1f * float(tenth) << " s";
    for (const Vehicle& v : simulation.vehicles()) {
      const glm::vec2 middle(v.point_behind(0.5f * v.length_m(), simulation.lanes()));
      ASSERT_LT(glm::distance(v.footprint(0.0f, simulation.lanes()).centre, middle), 0.9f);
    }
  }
  for (std::size_t i = 0; i < travelled_at_start.size(); ++i)
    EXPECT_GT(simulation.vehicles()[i].travelled_m - travelled_at_start[i], 150.0) << "vehicle " << i;
}

TEST(Traffic, ThirtyVehiclesOnAGrid) { expect_orderly_traffic(scene_of(grid(3, 80.0f), 30)); }

TEST(Traffic, ThreeHundredVehiclesOnAGrid) { expect_orderly_traffic(scene_of(grid(6, 100.0f), 300)); }

TEST(Traffic, SeveralLanes) { expect_orderly_traffic(scene_of(grid(3, 120.0f, 2), 60)); }

TEST(Traffic, CrowdedDeadEnds) { expect_orderly_traffic(scene_of({road({{0, 0, 0}, {150, 0, 0}})}, 100)); }

TEST(Traffic, ObliqueCrossingsAndBends) {
  expect_orderly_traffic(
      scene_of({road({{-150, -20, 0}, {0, 0, 0}, {150, 60, 0}}), road({{-100, -120, 0}, {40, 120, 0}}),
                road({{-120, 60, 0}, {-20, 70, 0}, {30, -110, 0}, {140, -60, 0}, {150, 60, 0}})},
               25));
}

TEST(Traffic, VehiclesFollowTheGraph) {
  const scene::Scene scene = scene_of(grid(3, 80.0f), 20);
  Traffic traffic(scene);
  std::vector<int> lanes;
  for (const Vehicle& v : traffic.simulation().vehicles()) lanes.push_back(v.lane());
  for (int i = 0; i < 60 * 60; ++i) {
    pass(traffic, step_s);
    for (std::size_t v = 0; v < lanes.size(); ++v) {
      const int lane = traffic.simulation().vehicles()[v].lane();
      if (lane == lanes[v]) continue;
      const std::vector<int>& next = traffic.simulation().lanes()[std::size_t(lanes[v])].next;
      ASSERT_NE(std::ranges::find(next, lane), next.end());
      lanes[v] = lane;
    }
  }
}

// Buses swing across the streets beside theirs: whoever waits for a whole street to be free waits long.
TEST(Traffic, BusesHoldNobodyUp) {
  std::vector<scene::Road> roads = grid(4, 150.0f);
  for (scene::Road& road : roads) road.lane_width_m = 3.4f;
  scene::Scene scene = scene_of(roads, 30);
  scene.data<TrafficDemand>().models.push_back(test_car(12.0f, 2.5f));
  scene.data<scene::DrivingArea>() = {{375.0f, 375.0f}, 250.0f};
  Traffic traffic(scene);
  ASSERT_EQ(traffic.vehicle_count(), 30u);
  std::vector<float> standing_s(traffic.vehicle_count(), 0.0f);
  float longest_s = 0.0f;
  for (int tenth = 0; tenth < 6000; ++tenth) {
    pass(traffic, 0.1f);
    for (std::size_t i = 0; i < standing_s.size(); ++i) {
      const bool stands = traffic.simulation().vehicles()[i].speed < 0.1f;
      standing_s[i] = stands ? standing_s[i] + 0.1f : 0.0f;
      longest_s = std::max(longest_s, standing_s[i]);
    }
  }
  EXPECT_LT(longest_s, 40.0f);
}

TEST(Traffic, StreetsAreCutBeforeTheirCrossings) {
  scene::RoadGraph roads;
  roads.lanes = {{{{0, 0, 0}, {100, 0, 0}}, {1}},
                 {{{100, 0, 0}, {110, 10, 0}}, {2}, 3.0f, 10.0f, 0},
                 {{{110, 10, 0}, {110, 30, 0}}, {}}};
  const CutStreets cut = cut_streets(roads, 8.0f);
  ASSERT_EQ(cut.roads.lanes.size(), 5u);
  EXPECT_EQ(cut.parts, (std::vector{LanePart::first_metres, LanePart::turn, LanePart::street,
                                    LanePart::street, LanePart::last_metres}));
  float length_m = 0.0f;
  int lane = 0;
  for (const int next : {3, 4, 1}) {
    length_m += scene::MeasuredPath(cut.roads.lanes[std::size_t(lane)].points).length();
    EXPECT_EQ(cut.roads.lanes[std::size_t(lane)].next, std::vector{next});
    lane = next;
  }
  EXPECT_NEAR(length_m, 100.0f, 1e-3f);
}

TEST(Traffic, IsTheSameAtAnyFrameRate) {
  action::Processes processes;
  processes.add([] { return std::make_unique<TrafficProcess>(); });
  scene::Scene slow = scene_of(grid(3, 80.0f), 30), fast = slow;
  action::SceneClock at_ten(processes, {}, slow), at_sixty(processes, {}, fast);
  for (int i = 0; i < 200; ++i) at_ten.advance(slow, 0.1);
  for (int i = 0; i < 1200; ++i) at_sixty.advance(fast, action::step_s);
  ASSERT_EQ(slow.objects.size(), 30u);
  for (std::size_t i = 0; i < slow.objects.size(); ++i)
    EXPECT_LT(glm::distance(slow.objects[i].world_from_model[3], fast.objects[i].world_from_model[3]), 0.01f);
}

TEST(Traffic, StandsWhileItIsPaused) {
  action::Processes processes;
  processes.add([] { return std::make_unique<TrafficProcess>(); });
  scene::Scene scene = scene_of(grid(3, 80.0f), 10);
  action::SceneClock clock(processes, {}, scene);
  TrafficProcess& traffic = *clock.find<TrafficProcess>();
  clock.advance(scene, 1.005);
  const std::vector<scene::Object> before = scene.objects;
  const auto farthest = [&] {
    float moved_m = 0.0f;
    for (std::size_t i = 0; i < before.size(); ++i)
      moved_m = std::max(moved_m,
                         glm::distance(before[i].world_from_model[3], scene.objects[i].world_from_model[3]));
    return moved_m;
  };
  clock.pause(traffic, true);
  clock.advance(scene, 2.0);
  EXPECT_EQ(farthest(), 0.0f);
  clock.step_alone(scene, traffic, 0.5);
  clock.advance(scene, 0.0);
  EXPECT_GT(farthest(), 1.0f);
  clock.pause(traffic, false);
  EXPECT_FALSE(clock.is_paused(traffic));
  EXPECT_EQ(traffic.status(), "10 vehicles");
}

TEST(Traffic, BodiesTurnSmoothly) {
  scene::Scene scene = scene_of(grid(2, 60.0f), 12);
  Traffic traffic(scene);
  traffic.add_vehicles(scene);
  const std::vector<scene::Object> start = scene.objects;
  std::vector<scene::Object> before = start;
  for (int i = 0; i < 60 * 60; ++i) {
    pass(traffic, step_s);
    traffic.place(scene, 0.0);
    for (std::size_t v = 0; v < before.size(); ++v) {
      const glm::vec3 old_forward(before[v].world_from_model[0]),
          forward(scene.objects[v].world_from_model[0]);
      ASSERT_GT(glm::dot(old_forward, forward), std::cos(glm::radians(3.0f)));
    }
    before = scene.objects;
  }
}

TEST(Traffic, WheelsRollAndSteer) {
  const VehicleShape shape = vehicle_shape(test_car(4.0f, 1.8f));
  ASSERT_EQ(shape.wheels.size(), 4u);
  EXPECT_NEAR(shape.wheelbase_m(), 2.4f, 1e-4f);
  std::vector<glm::mat4> pose = shape.rest_pose;
  const double quarter_turn_m = 0.25 * 2.0 * 3.14159265 * 0.3;
  shape.set_pose(quarter_turn_m, 0.3f, pose);
  EXPECT_EQ(pose[0], shape.rest_pose[0]);
  for (const Wheel& wheel : shape.wheels) {
    const glm::mat4& model_from_wheel = pose[std::size_t(wheel.node)];
    EXPECT_LT(glm::distance(glm::vec3(model_from_wheel[3]), wheel.centre_in_model), 1e-4f);
    const glm::vec3 top(model_from_wheel * glm::vec4(0, 0, 1, 0));  // what was up now points ahead
    EXPECT_NEAR(top.x, wheel.is_front ? std::cos(0.3f) : 1.0f, 1e-4f);
    EXPECT_NEAR(top.y, wheel.is_front ? std::sin(0.3f) : 0.0f, 1e-4f);
  }
}

TEST(Traffic, PitchesWithTheSlope) {
  scene::Scene scene = scene_of({road({{0, 0, 0}, {200, 0, 20}})}, 4);
  Traffic traffic(scene);
  traffic.add_vehicles(scene);
  for (const scene::Object& object : scene.objects) {
    const glm::vec3 forward(object.world_from_model[0]);
    if (std::abs(forward.x) > 0.98f) {
      EXPECT_NEAR(forward.z / forward.x, 0.1f, 0.01f);
    }
    EXPECT_TRUE(object.is_dynamic && object.takes_reflection);
  }
}

TEST(Traffic, WithoutRoadsNobodyDrives) {
  scene::Scene scene = scene_of({}, 10);
  Traffic traffic(scene);
  traffic.add_vehicles(scene);
  pass(traffic, 1.0f);
  EXPECT_TRUE(scene.objects.empty());
  ASSERT_EQ(traffic.warnings().size(), 1u);
  EXPECT_NE(traffic.warnings()[0].find("no roads"), std::string::npos);
}

TEST(Traffic, WithoutModelsNobodyDrives) {
  scene::Scene scene = scene_of(grid(2, 60.0f), 10);
  scene.data<TrafficDemand>().models.clear();
  const Traffic traffic(scene);
  EXPECT_EQ(traffic.vehicle_count(), 0u);
  EXPECT_EQ(traffic.warnings().size(), 1u);
}

TEST(Traffic, OneWayRoadsThatEndAreNotUsed) {
  scene::Road lone = road({{0, 0, 0}, {100, 0, 0}});
  lone.is_one_way = true;
  const Traffic traffic(scene_of({lone}, 5));
  EXPECT_EQ(traffic.vehicle_count(), 0u);
  EXPECT_EQ(traffic.warnings().size(), 1u);
}

TEST(Traffic, VehiclesKeepToTheirPartOfTheTown) {
  constexpr float spacing_m = 100.0f, radius_m = 150.0f;
  const glm::vec2 centre(200.0f, 300.0f);
  scene::Scene scene = scene_of(grid(8, spacing_m), 25);
  const auto farthest_m = [&] {
    Traffic traffic(scene);
    float farthest = 0.0f;
    for (int second = 0; second < 300; ++second) {
      pass(traffic, 1.0f);
      for (const Vehicle& v : traffic.simulation().vehicles())
        farthest = std::max(
            farthest, glm::distance(glm::vec2(v.front_axle(0.0f, traffic.simulation().lanes())), centre));
    }
    EXPECT_EQ(traffic.vehicle_count(), 25u);
    return farthest;
  };
  EXPECT_GT(farthest_m(), 400.0f) << "without an area they go everywhere";
  scene.data<scene::DrivingArea>() = {centre, radius_m};
  EXPECT_LT(farthest_m(), radius_m + 5.0f) << "but for the width of a crossing at its rim";
}

TEST(Traffic, MoreVehiclesThanRoomAreTurnedAway) {
  const Traffic traffic(scene_of(grid(2, 60.0f), 10000));
  EXPECT_LT(traffic.vehicle_count(), 200u);
  EXPECT_EQ(traffic.warnings().size(), 1u);
}

TEST(Traffic, StopsBeforeCrossingsThatPeopleWalkOver) {
  const scene::Scene scene = scene_of(grid(3, 120.0f), 12);
  for (const bool are_heeded : {true, false}) {
    Traffic traffic(scene);
    scene::StreetTraffic streets;
    streets.has_people = true;
    streets.crossings = scene::street_crossings(scene);
    streets.people.assign(streets.crossings.size(), 0);
    ASSERT_FALSE(streets.crossings.empty());
    traffic.share(streets);
    int driven_onto = 0;
    std::vector<bool> was_taken(streets.crossings.size(), false);
    for (int s = 0; s < 60 * 60; ++s) {
      // Somebody walks wherever no vehicle was, every other ten seconds.
      for (std::size_t c = 0; c < streets.crossings.size(); ++c) {
        const bool is_on = std::ranges::any_of(streets.vehicles, [&](const auto& vehicle) {
          return streets.crossings[c].contains(vehicle.front) || streets.crossings[c].contains(vehicle.rear);
        });
        if (streets.people[c] != 0 && is_on && !was_taken[c]) ++driven_onto;
        was_taken[c] = streets.taken[c] != 0 || is_on;
        const bool walks = s / 600 % 2 == 0 && (streets.people[c] != 0 || streets.taken[c] == 0) && !is_on;
        streets.people[c] = walks ? 1 : 0;
      }
      streets.has_people = are_heeded;
      traffic.step();
    }
    if (are_heeded)
      EXPECT_EQ(driven_onto, 0);
    else
      EXPECT_GT(driven_onto, 5) << "the control: drivers who do not look";
  }
}

TEST(Traffic, BicyclesRideAtTheirOwnSpeedAndTheirCranksTurn) {
  scene::Scene scene;
  scene.roads = *scene::build_road_graph(grid(2, 90.0f));
  TrafficDemand demand;
  demand.bicycles = 3;
  scene.data<TrafficDemand>() = demand;
  Traffic traffic(scene);
  EXPECT_TRUE(traffic.warnings().empty()) << "they need no model";
  ASSERT_EQ(traffic.vehicle_count(), 3u);
  traffic.add_vehicles(scene);
  const scene::Object& first = scene.objects.front();
  ASSERT_EQ(first.deformed_meshes.size(), first.model->parts.size());
  const auto foot = [&] {  // the lowest point of what deforms
    float lowest = 1e9f;
    for (std::size_t p = 0; p < first.model->parts.size(); ++p)
      if (first.model->parts[p].deformation)
        for (const glm::vec3 v : first.deformed_meshes[p].positions) lowest = std::min(lowest, v.z);
    return lowest;
  };
  float least = 1e9f, most = 0.0f;
  for (int s = 0; s < 60 * 60; ++s) {
    traffic.step(), traffic.place(scene, 0.0);
    if (s % 7 == 0) least = std::min(least, foot()), most = std::max(most, foot());
  }
  EXPECT_GT(least, 0.02f) << "feet stay clear of the road";
  EXPECT_LT(least, 0.16f);
  EXPECT_GT(most - least, 0.08f) << "pedals go round";
  for (const Vehicle& vehicle : traffic.simulation().vehicles()) {
    EXPECT_LT(vehicle.speed, 6.3f);
    EXPECT_GT(vehicle.travelled_m, 150.0);
    EXPECT_LT(vehicle.length_m(), 2.0f);
  }
}

}  // namespace
}  // namespace parvis::traffic
