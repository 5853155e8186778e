#include "land/roads/road_from_polygons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "land/roads/skeleton.h"
#include "scene/data/path.h"

namespace parvis::scene {
namespace {

/// A rectangle about the line from `a` to `b`.
RoadPolygon strip(glm::vec3 a, glm::vec3 b, float width, const std::string& function = "rijbaan lokale weg") {
  const glm::vec3 aside = 0.5f * width * right_of(b - a);
  return {{{a + aside, b + aside, b - aside, a - aside}}, function};
}

std::size_t crossings(const RoadGraph& graph) {
  std::vector<int> ids;
  for (const Lane& lane : graph.lanes)
    if (lane.crossing >= 0) ids.push_back(lane.crossing);
  std::ranges::sort(ids);
  return std::size_t(std::ranges::unique(ids).begin() - ids.begin());
}

TEST(RoadFromPolygons, AStreetIsItsMiddleLine) {
  const std::vector<Road> roads = roads_from_polygons(std::vector{strip({10, 5, 1}, {90, 45, 5}, 6.0f)});
  ASSERT_EQ(roads.size(), 1u);
  EXPECT_EQ(roads[0].lanes_each_way, 1);
  EXPECT_NEAR(roads[0].lane_width_m, 3.0f, 0.4f);
  const glm::vec3 along = glm::normalize(glm::vec3(80, 40, 4));
  for (const glm::vec3& p : roads[0].path) {
    const glm::vec3 away = p - glm::vec3(10, 5, 1);
    EXPECT_LT(glm::length(away - glm::dot(away, along) * along), 0.6f);
  }
  EXPECT_GT(MeasuredPath(roads[0].path).length(), 75.0f);
}

TEST(RoadFromPolygons, CrossingStreetsMeetInOnePlace) {
  const std::vector<Road> roads = roads_from_polygons(
      std::vector{strip({0, 50, 0}, {100, 55, 0}, 7.0f), strip({48, 0, 0}, {52, 100, 0}, 6.0f)});
  ASSERT_EQ(roads.size(), 4u);
  const Result<RoadGraph> graph = build_road_graph(roads);
  ASSERT_TRUE(graph.ok()) << to_string(graph.errors());
  EXPECT_EQ(crossings(*graph), 5u);  // and four dead ends
}

TEST(RoadFromPolygons, RoundaboutsAreDrivenAround) {
  RoadPolygon ring;
  ring.rings.resize(2);
  for (int i = 0; i < 48; ++i) {
    const float angle = 6.2831853f * float(i) / 48.0f;
    const glm::vec3 outward(std::cos(angle), std::sin(angle), 0.0f);
    ring.rings[0].push_back(30.0f * outward), ring.rings[1].push_back(24.0f * outward);
  }
  const std::vector<Road> roads = roads_from_polygons(std::vector{ring});
  ASSERT_EQ(roads.size(), 1u);
  EXPECT_EQ(roads[0].path.front(), roads[0].path.back());
  EXPECT_NEAR(MeasuredPath(roads[0].path).length(), 170.0f, 10.0f);
  EXPECT_TRUE(build_road_graph(roads).ok());
}

TEST(RoadFromPolygons, GapsAndIslandsAreNoObstacle) {
  RoadPolygon street = strip({0, 0, 0}, {49, 0, 0}, 8.0f);
  street.rings.push_back({{20, -1, 0}, {24, -1, 0}, {24, 1, 0}, {20, 1, 0}});
  EXPECT_EQ(roads_from_polygons(std::vector{street, strip({50, 0, 0}, {100, 0, 0}, 8.0f)}).size(), 1u);
}

TEST(RoadFromPolygons, WideRoadsHaveSeveralLanes) {
  const std::vector<Road> roads = roads_from_polygons(std::vector{strip({0, 0, 0}, {120, 0, 0}, 13.0f)});
  ASSERT_EQ(roads.size(), 1u);
  EXPECT_EQ(roads[0].lanes_each_way, 2);
}

TEST(RoadFromPolygons, WhatIsNotForVehiclesIsLeftOut) {
  EXPECT_TRUE(roads_from_polygons(std::vector{strip({0, 0, 0}, {90, 0, 0}, 6.0f, "voetpad"),
                                              strip({0, 20, 0}, {90, 20, 0}, 1.5f),  // a car does not fit
                                              strip({0, 40, 0}, {12, 40, 0}, 6.0f)})
                  .empty());
  EXPECT_TRUE(roads_from_polygons({}).empty());
  EXPECT_TRUE(is_drivable(""));
  EXPECT_TRUE(is_drivable("Rijbaan lokale weg"));
  EXPECT_FALSE(is_drivable("Parkeervlak"));
}

TEST(RoadFromPolygons, HostilePolygonsGiveNothing) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const RoadPolygon no_ring{{}, ""}, two_points{{{{0, 0, 0}, {50, 0, 0}}}, ""};
  const RoadPolygon flat{{{{0, 0, 0}, {50, 0, 0}, {80, 0, 0}}}, ""},
      broken{{{{0, 0, 0}, {nan, 0, 0}, {0, 9, 0}}}, ""};
  const RoadPolygon upright{{{{0, 0, 0}, {50, 0, 0}, {50, 0, 9}}}, ""};
  EXPECT_TRUE(roads_from_polygons(std::vector{no_ring, two_points, flat, broken, upright}).empty());
}

TEST(GroundRaster, DistancesAreExact) {
  Mask mask(40, 30, 0.5f, {0, 0}, 0);
  mask.at(7, 5) = 1, mask.at(30, 22) = 1;
  const GroundRaster<float> distances = distances_to(mask, 1);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      const float a = glm::distance(glm::vec2(x, y), glm::vec2(7, 5)),
                  b = glm::distance(glm::vec2(x, y), glm::vec2(30, 22));
      EXPECT_NEAR(distances.at(x, y), 0.5f * std::min(a, b), 1e-4f);
    }
}

TEST(GroundRaster, DistancesToNothingAreFar) {
  const GroundRaster<float> distances = distances_to(Mask(8, 8, 1.0f, {0, 0}, 0), 1);
  EXPECT_GT(distances.at(3, 3), 1e6f);
}

}  // namespace
}  // namespace parvis::scene
