#include "formats/city_models/osm_earthworks.h"

#include <gtest/gtest.h>

#include "formats/city_models/test_osm.h"
#include "formats/terrain/utm.h"

namespace parvis::scene {
namespace {

/// A hillside that rises by a fifth to the north, 100 m high at the origin of a test's map.
GroundOnMap hillside() {
  const double origin_m = Utm({3.0, 52.16})({3.0, 52.16}).y;
  return [origin_m](glm::dvec2 on_map) { return 100.0 + 0.2 * (on_map.y - origin_m); };
}

Road road_at(double z) {
  Road road;
  for (int x = -100; x <= 100; x += 10) road.path.emplace_back(float(x), 0.0f, float(z));
  return road;
}

TEST(OsmEarthworks, TheGroundIsLevelAcrossAStreetAndAsItWasFarFromIt) {
  const GroundOnMap bare = [](glm::dvec2 p) { return 100.0 + 0.2 * (p.y - 5000.0); };
  const glm::dvec3 origin(1000.0, 5000.0, 0.0);
  const GroundOnMap shaped = ground_shaped_for({road_at(100.0)}, bare, origin);
  for (const double y : {-6.0, 0.0, 6.0}) EXPECT_NEAR(shaped({1000.0, 5000.0 + y}), 100.0, 1e-3) << y;
  EXPECT_DOUBLE_EQ(shaped({1000.0, 5050.0}), bare({1000.0, 5050.0}));
  const GroundOnMap below_ramp = ground_shaped_for({road_at(100.5)}, bare, origin);
  EXPECT_NEAR(below_ramp({1000.0, 4996.0}), bare({1000.0, 4996.0}), 1e-3) << "a ramp has its own dam";
  EXPECT_FALSE(ground_shaped_for({road_at(100.0)}, {}, origin));
}

TEST(OsmEarthworks, HousesAndTreesStandOnTheGroundBesideTheStreet) {
  TestMap map;
  map.add_line({{-100, 0}, {100, 0}}, {{"highway", "residential"}});
  map.add_area({{-5, 8}, {5, 8}, {5, 16}, {-5, 16}}, {{"building", "yes"}, {"height", "6"}});
  map.add_line({{-60, 9}, {-20, 9}}, {{"natural", "tree_row"}});
  const TestTown town = read(map, hillside());
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(bounds_of(*town.model, "WallSurface").min.z, 100.66f, 0.1f)
      << "at the foot of the cut; control: 101.6 m on the bare ground";
  EXPECT_NEAR(bounds_of(*town.model, "SolitaryVegetationObject").min.z, 101.23f, 0.1f) << "control: 101.8 m";
}

TEST(OsmEarthworks, FarFromStreetsHousesStandOnTheBareGround) {
  TestMap map;
  map.add_line({{-100, 0}, {100, 0}}, {{"highway", "residential"}});
  map.add_area({{-5, 60}, {5, 60}, {5, 70}, {-5, 70}}, {{"building", "yes"}, {"height", "6"}});
  const TestTown town = read(map, hillside());
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(bounds_of(*town.model, "WallSurface").min.z, 112.0f, 0.1f);
}

TEST(OsmEarthworks, TramsLieInTheStreet) {
  TestMap map;
  map.add_line({{-100, 0}, {100, 0}}, {{"highway", "residential"}});
  map.add_line({{-80, 2}, {80, 2}}, {{"railway", "tram"}});
  const TestTown town = read(map, hillside());
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(bounds_of(*town.model, "CityFurniture").max.z, 100.085f, 0.02f) << "control: 100.5 m";
}

}  // namespace
}  // namespace parvis::scene
