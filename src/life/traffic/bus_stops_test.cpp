#include "life/traffic/bus_stops.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "land/roads/road_builder.h"
#include "life/traffic/test_cars.h"
#include "life/traffic/traffic.h"

namespace parvis::traffic {
namespace {

std::shared_ptr<const scene::Model> test_bus() {
  auto bus = std::make_shared<scene::Model>(*test_car(9.5f, 2.3f));
  bus->name = "city bus";
  return bus;
}

/// Two streets that cross, with buses or cars, and a stop at the right side of one that leads east.
struct Streets {
  scene::Scene scene;

  explicit Streets(std::shared_ptr<const scene::Model> vehicle, glm::vec3 stop = {60, -4.2f, 0},
                   int vehicles = 4) {
    scene::Road east, north;
    east.path = {{-150, 0, 0}, {150, 0, 0}}, north.path = {{0, -150, 0}, {0, 150, 0}};
    east.lane_width_m = north.lane_width_m = 3.5f;
    scene.roads = *scene::build_road_graph(std::vector<scene::Road>{east, north});
    scene.data<TrafficDemand>() = {vehicles, 7, {std::move(vehicle)}};
    BusStopDemand demand;
    demand.position = stop, demand.dwell_s = 8.0f;
    scene.data<scene::ItemsOf<BusStopDemand>>().add(demand, 0);
  }
};

/// How often doors opened within some minutes, for how long in all, and where the front bumpers were.
struct Opened {
  int times = 0;
  float seconds = 0.0f, farthest_off_m = 0.0f;
};

Opened opened(Traffic& traffic, float seconds, int boarding = 0) {
  Opened result;
  bool was_open = false;
  for (float t = 0.0f; t < seconds; t += step_s) {
    scene::TransitStop& stop = traffic.stops()->front();
    stop.boarding = stop.is_open ? boarding : 0;
    traffic.step();
    result.times += stop.is_open && !was_open ? 1 : 0;
    was_open = stop.is_open;
    if (!stop.is_open) continue;
    result.seconds += step_s;
    float nearest_m = 1e9f;
    for (const Vehicle& vehicle : traffic.simulation().vehicles())
      nearest_m = std::min(nearest_m, glm::distance(vehicle.point_behind(0.0f, traffic.simulation().lanes()),
                                                    glm::vec3(60, -1.75f, 0)));
    result.farthest_off_m = std::max(result.farthest_off_m, nearest_m);
  }
  return result;
}

TEST(BusStop, BusesHaltAtItEachTimeTheyPassAndOpenTheirDoors) {
  const Streets streets(test_bus());
  Traffic traffic(streets.scene);
  ASSERT_EQ(traffic.stops()->size(), 1u);
  const scene::TransitStop stop = traffic.stops()->front();
  EXPECT_EQ(stop.doors.size(), 2u);
  EXPECT_LT(stop.away.y, -0.9f) << "people wait at the right of the lane";
  EXPECT_NEAR(glm::distance(stop.from, stop.to), 9.5f, 0.1f);
  const Opened seen = opened(traffic, 900.0f);
  EXPECT_GT(seen.times, 4);
  EXPECT_NEAR(seen.seconds / float(seen.times), 8.0f, 0.5f);
  EXPECT_LT(seen.farthest_off_m, 1.6f) << "where the pole stands";
  for (const Vehicle& vehicle : traffic.simulation().vehicles())
    EXPECT_GT(vehicle.travelled_m, 600.0) << "and drive on";
}

TEST(BusStop, DoorsWaitForWhoIsOnTheWayToThem) {
  const Streets streets(test_bus());
  Traffic traffic(streets.scene);
  ASSERT_EQ(traffic.stops()->size(), 1u);
  const Opened seen = opened(traffic, 900.0f, 1);
  ASSERT_GT(seen.times, 3);
  EXPECT_NEAR(seen.seconds / float(seen.times), 8.0f + bus_waits_s, 1.5f) << "but not for ever";
}

TEST(BusStop, CarsPassIt) {
  const Streets streets(test_car(4.4f, 1.8f));
  const Traffic traffic(streets.scene);
  EXPECT_TRUE(traffic.stops()->empty());
  EXPECT_TRUE(traffic.warnings().empty()) << "a pole alone is no mistake";
}

TEST(BusStop, WhereNoLaneLeadsPastIsAWarning) {
  const Streets streets(test_bus(), {60, 40, 0});
  const Traffic traffic(streets.scene);
  EXPECT_TRUE(traffic.stops()->empty());
  ASSERT_EQ(traffic.warnings().size(), 1u);
  EXPECT_NE(traffic.warnings()[0].find("60.0 40.0"), std::string::npos) << traffic.warnings()[0];
  EXPECT_FALSE(kerbward_of(streets.scene.roads, {60, 40, 0}));
  const auto kerbward = kerbward_of(streets.scene.roads, {60, -4.2f, 0});
  ASSERT_TRUE(kerbward);
  EXPECT_LT(kerbward->y, -0.9f);
}

}  // namespace
}  // namespace parvis::traffic
