#include "life/traffic/signals.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "land/roads/road_builder.h"
#include "life/traffic/test_cars.h"
#include "life/traffic/traffic.h"
#include "room_list.h"
#include "scene/script/test_script.h"

namespace parvis::traffic {
namespace {

/// Two streets that cross at the origin, with lights.
struct Crossroads {
  scene::Scene scene;
  std::vector<scene::StreetCrossing> crossings;
  SignalJunction junction;

  explicit Crossroads(int vehicles = 0) {
    scene::Road east, north;
    east.path = {{-150, 0, 0}, {150, 0, 0}}, north.path = {{0, -150, 0}, {0, 150, 0}};
    east.lane_width_m = north.lane_width_m = 3.5f;
    scene.roads = *scene::build_road_graph(std::vector<scene::Road>{east, north});
    crossings = scene::street_crossings(scene);
    scene.data<TrafficDemand>() = {vehicles, 7, {test_car(4.4f, 1.8f)}};
    SignalDemand demand;
    demand.position = {4, -3, 0};
    scene.data<scene::ItemsOf<SignalDemand>>().add(demand, 0);
    junction = *signals_at(scene.roads, crossings, demand);
  }
};

TEST(Signals, StreetsThatFaceEachOtherHaveGreenTogetherAndNobodyElse) {
  const Crossroads place;
  ASSERT_EQ(place.junction.phases, 2);
  ASSERT_EQ(place.junction.approaches.size(), 4u);
  ASSERT_EQ(place.junction.walks.size(), 4u);
  for (const SignalApproach& approach : place.junction.approaches) {
    EXPECT_EQ(approach.phase,
              place.junction.approaches[0].phase ^
                  int(std::abs(glm::dot(approach.away, place.junction.approaches[0].away)) < 0.5f));
    for (const scene::StreetCrossing& crossing : place.crossings)
      EXPECT_FALSE(crossing.contains(glm::vec2(approach.stop), 0.5f)) << "lines lie before crossings";
  }
  Signals signals({place.junction}, place.scene.roads, place.crossings.size());
  std::vector<float> green_s(2, 0.0f), walk_s(4, 0.0f), since_walk_s(4, 1e3f);
  for (float t = 0.0f; t < 300.0f; t += step_s) {
    signals.step(step_s, {});
    const DriveLight a = signals.light(0, 0), b = signals.light(0, 1);
    ASSERT_TRUE(a == DriveLight::red || b == DriveLight::red);
    for (int phase = 0; phase < 2; ++phase)
      green_s[std::size_t(phase)] += signals.light(0, phase) == DriveLight::green ? step_s : 0.0f;
    for (std::size_t w = 0; w < 4; ++w) {
      const SignalWalk& walk = place.junction.walks[w];
      const bool walks = signals.walk_lights()[std::size_t(walk.crossing)] == scene::WalkLight::walk;
      since_walk_s[w] = walks ? 0.0f : since_walk_s[w] + step_s;
      walk_s[w] += walks ? step_s : 0.0f;
      if (signals.light(0, walk.phase) != DriveLight::red) {
        ASSERT_GE(since_walk_s[w], 7.0f / 1.2f) << "people are across before cars come";
      }
    }
  }
  for (const float s : green_s) EXPECT_GT(s, 100.0f);
  for (const float s : walk_s) EXPECT_GT(s, 50.0f);
}

TEST(Signals, ATramEndsTheGreenOfTheStreetThatItCrossesAlone) {
  const Crossroads place;
  Signals signals({place.junction}, place.scene.roads, place.crossings.size());
  const int east = std::ranges::find_if(place.junction.approaches, [](const SignalApproach& approach) {
                     return std::abs(approach.away.x) > 0.9f;
                   })->phase;
  // A track along the street to the north, beside it: only who goes east or west must cross it.
  scene::RailCrossing rail{{{5, -40, 0}, {5, 40, 0}, 1.8f}, 10.0f};
  for (float t = 0.0f; t < 14.0f; t += step_s) signals.step(step_s, std::span(&rail, 1));
  rail.tram_in_s = 0.0f;
  for (float t = 0.0f; t < 120.0f; t += step_s) {
    signals.step(step_s, std::span(&rail, 1));
    ASSERT_EQ(signals.light(0, east), DriveLight::red);
  }
  EXPECT_EQ(signals.light(0, 1 - east), DriveLight::green) << "who drives along the track need not wait";
  rail.tram_in_s = 60.0f;
  bool was_green = false;
  for (float t = 0.0f; t < 60.0f; t += step_s) {
    signals.step(step_s, std::span(&rail, 1));
    was_green |= signals.light(0, east) == DriveLight::green;
  }
  EXPECT_TRUE(was_green) << "afterwards they have their turn";
}

/// Vehicles that pass a stop line while the light behind it is red, in five minutes; how far all got.
std::pair<int, double> passed_at_red(bool heeds_signals) {
  Crossroads place(14);
  Traffic traffic(place.scene, place.crossings);
  traffic.simulation().heeds_signals = heeds_signals;
  const Simulation& simulation = traffic.simulation();
  std::vector<glm::vec2> before(simulation.vehicles().size());
  int count = 0;
  for (int step = 0; step < 5 * 60 * 60; ++step) {
    traffic.step();
    for (std::size_t v = 0; v < before.size(); ++v) {
      const Vehicle& vehicle = simulation.vehicles()[v];
      const glm::vec2 front(vehicle.point_behind(0.0f, simulation.lanes()));
      for (const SignalApproach& approach : place.junction.approaches) {
        const glm::vec2 was = before[v] - glm::vec2(approach.stop), is = front - glm::vec2(approach.stop);
        const bool passes = step > 0 && glm::dot(was, approach.away) > 0.0f &&
                            glm::dot(is, approach.away) <= 0.0f && glm::length(is) < approach.half_width_m;
        count += passes && simulation.signals().light(0, approach.phase) == DriveLight::red ? 1 : 0;
      }
      before[v] = front;
    }
  }
  double min_m = 1e9;
  for (const Vehicle& vehicle : simulation.vehicles()) min_m = std::min(min_m, vehicle.travelled_m);
  return {count, min_m};
}

TEST(Signals, NobodyDrivesAtRedAndEverybodyGetsOn) {
  const auto [count, min_m] = passed_at_red(true);
  EXPECT_EQ(count, 0);
  EXPECT_GT(min_m, 200.0);
  EXPECT_GT(passed_at_red(false).first, 5) << "the control";
}

TEST(Signals, NoVehicleStandsOnATrackWhenATramComes) {
  Crossroads place(14);
  Traffic traffic(place.scene, place.crossings);
  scene::StreetTraffic streets;
  streets.rail_crossings.push_back({{{60, -6, 0}, {60, 6, 0}, 1.8f}});
  traffic.share(streets);
  int on_track = 0, passes = 0;
  for (int second = 0; second < 600; ++second) {
    const int of_cycle = second % 40;  // a tram is on it for 10 s of 40
    for (int step = 0; step < 60; ++step) {
      streets.rail_crossings[0].tram_in_s = of_cycle < 30 ? float(30 - of_cycle) : 0.0f;
      traffic.step();
      for (const scene::StreetTraffic::Vehicle& vehicle : streets.vehicles) {
        const bool is_on = streets.rail_crossings[0].strip.contains(0.5f * (vehicle.front + vehicle.rear));
        passes += is_on ? 1 : 0;
        on_track += is_on && of_cycle >= 30 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(passes, 60);
  EXPECT_EQ(on_track, 0);
}

TEST(Signals, FarFromAJunctionAreAnError) {
  const Crossroads place;
  SignalDemand demand;
  demand.position = {100, 0, 0};
  const Result<SignalJunction> lights = signals_at(place.scene.roads, place.crossings, demand);
  ASSERT_FALSE(lights);
  EXPECT_NE(to_string(lights.errors()).find("no junction of three streets"), std::string::npos);
}

class LightsNodeTest : public scene::ScriptTest<> {
 protected:
  LightsNodeTest()
      : ScriptTest([] {
          Registries registries;
          script::register_room(registries), action::register_room(registries),
              meshes::register_room(registries), roads::register_room(registries),
              traffic::register_room(registries);
          return registries;
        }()) {}
};

TEST_F(LightsNodeTest, NeedAPlaceOrAMap) {
  constexpr const char* streets = "road(path=\"-80 0, 80 0\")\nroad(path=\"0 -80, 0 80\")\n";
  const scene::Scene lit = scene_of(std::string(streets) + "trafficLights(position=\"0 0 0\")\n");
  EXPECT_EQ(lit.items<SignalDemand>().size(), 1u);
  EXPECT_TRUE(holds(errors_of(std::string(streets) + "trafficLights()"), "scene.xp:3:1: "));
  EXPECT_TRUE(
      holds(errors_of(std::string(streets) + "trafficLights(of=\"town\")"), "no model called \"town\""));
}

TEST(Signals, OfAMapStandAtJunctionsOnce) {
  Crossroads place;
  SignalDemand of_map;
  of_map.is_of_map = true;
  for (const glm::vec3 p : {glm::vec3(9, 0, 0), {-9, 0, 0}, {120, 0, 0}}) {
    of_map.position = p;
    place.scene.data<scene::ItemsOf<SignalDemand>>().add(of_map, 1);
  }
  const Traffic traffic(place.scene, place.crossings);
  EXPECT_EQ(traffic.simulation().signals().junctions().size(), 1u)
      << "one junction, whatever the map has beside it";
}

}  // namespace
}  // namespace parvis::traffic
