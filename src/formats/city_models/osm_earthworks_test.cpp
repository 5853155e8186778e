#include "formats/city_models/osm_earthworks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formats/city_models/test_osm.h"
#include "formats/terrain/map_projection.h"
#include "land/roads/road_beds.h"
#include "land/roads/road_builder.h"
#include "land/roads/shaped_terrain.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

/// A hillside that rises by a fifth to the north, 100 m high at the origin of a test's map.
GroundOnMap hillside() {
  const double origin_m = MapProjection::utm({3.0, 52.16})({3.0, 52.16}).y;
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

TEST(OsmEarthworks, TheGroundInTheCornersOfCrossingsIsThatOfTheTerrain) {
  constexpr float rise = 0.2f;
  std::vector<Road> roads(2);
  const glm::vec2 oblique(0.5f, 0.8660254f);  // 60 degrees: turns go round the corners outside of both beds
  for (int along_m = -50; along_m <= 50; along_m += 10) {
    const glm::vec2 other = float(along_m) * oblique;
    roads[0].path.emplace_back(float(along_m), 0.0f, 0.0f);
    roads[1].path.emplace_back(other, rise * other.y);
  }
  Scene scene;
  auto hill =
      model_of(quad({-60, -60, -12}, {60, -60, -12}, {60, 60, 12}, {-60, 60, 12}), matt(glm::vec3(1)));
  hill->parts.front().object = "TINRelief";
  add(scene, hill);
  scene.roads = *build_road_graph(roads);
  ASSERT_TRUE(shape_terrain(scene, roads));

  const GroundOnMap bare = [](glm::dvec2 p) { return double(rise) * p.y; };
  const GroundOnMap shaped = ground_shaped_for(roads, bare, glm::dvec3(0.0));
  std::vector<RoadBed> without_turns(2);
  for (std::size_t i = 0; i < roads.size(); ++i) {
    without_turns[i].half_m = half_bed_m(roads[i]);
    for (const glm::vec3& point : roads[i].path) without_turns[i].points.push_back({point});
  }
  const Earthworks sharp(without_turns);
  constexpr double tolerance_m = 0.005;  // of heights in floats, and of points between those of a bed
  double error_m = 0.0, sharp_error_m = 0.0;
  for (const glm::vec3& p : scene.objects.front().model->parts.front().mesh.positions) {
    error_m = std::max(error_m, std::abs(shaped(glm::dvec2(p)) - double(p.z)));
    sharp_error_m = std::max(sharp_error_m, double(std::abs(sharp.at(glm::vec2(p), rise * p.y) - p.z)));
  }
  EXPECT_LT(error_m, tolerance_m);
  EXPECT_GT(sharp_error_m, 0.03) << "control: without the turns";
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
