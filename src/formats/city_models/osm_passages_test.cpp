#include "formats/city_models/osm_passages.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/city_models/test_osm.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;

const std::vector<dvec2> long_house{{0, 0}, {20, 0}, {20, 10}, {0, 10}};
const TestTags house_tags{{"building", "yes"}, {"height", "12"}};
constexpr const char *wall_surface = "WallSurface", *ceiling = "OuterCeilingSurface";

TestTags passage(TestTags more = {}) {
  more.insert(more.end(), {{"highway", "service"}, {"tunnel", "building_passage"}, {"width", "4"}});
  return more;
}
constexpr double passage_width_m = 4.8;  // with some room on both sides

/// The town is closed but for `floor_m2` of ground that its buildings stand on.
void expect_closed(const Model& model, double floor_m2) {
  const dvec3 all = directed_area_m2(model, wall_surface) + directed_area_m2(model, ceiling) +
                    directed_area_m2(model, "RoofSurface");
  EXPECT_NEAR(all.x, 0.0, 0.02);
  EXPECT_NEAR(all.y, 0.0, 0.02);
  EXPECT_NEAR(all.z, floor_m2, 0.005 * floor_m2);
}

TEST(OsmPassages, StreetsLeadThroughBuildings) {
  TestMap map;
  map.add_area(long_house, house_tags);
  map.add_line({{10, 0}, {10, 10}}, passage());
  map.add_line({{10, -30}, {10, 0}}, {{"highway", "service"}});
  const TestTown town = read(map);
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_EQ(town.warnings, "");
  EXPECT_NEAR(bounds_of(*town.model, ceiling).min.z, 3.5f, 1e-3f);
  EXPECT_NEAR(bounds_of(*town.model, ceiling).max.z, 3.5f, 1e-3f);
  EXPECT_NEAR(directed_area_m2(*town.model, ceiling).z, -passage_width_m * 10.0, 0.1);
  EXPECT_NEAR(area_m2(*town.model, wall_surface),
              60.0 * 12.0 - 2.0 * passage_width_m * 3.5 + 2.0 * 10.0 * 3.5, 1.0)
      << "with walls on both sides of the passage";
  expect_closed(*town.model, 200.0 - passage_width_m * 10.0);
  const float middle = bounds_of(*town.model, wall_surface).centre().x;
  for (const Part& part : town.model->parts)
    for (const glm::vec3& p : part.mesh.positions)
      if (part.object == wall_surface && p.z < 3.4f) {
        EXPECT_GT(std::abs(p.x - middle), 0.49f * float(passage_width_m)) << "in the way";
      }
  EXPECT_EQ(town.model->roads.size(), 2u);
}

TEST(OsmPassages, HeightsAreThoseOfTheTagsAboveTheGroundOfTheWay) {
  const auto top_m = [](const TestTags& tags, const GroundOnMap& ground) {
    TestMap map;
    map.add_area(long_house, house_tags);
    map.add_line({{10, 0}, {10, 10}}, tags);
    const TestTown town = read(map, ground);
    EXPECT_TRUE(town.model) << to_string(town.model.errors());
    return bounds_of(*town.model, ceiling).max.z;
  };
  EXPECT_NEAR(top_m(passage({{"maxheight", "4.2"}}), {}), 4.2f, 1e-3f);
  EXPECT_NEAR(top_m(passage({{"maxheight", "13'6&quot;"}}), {}), 13.5 * 0.3048, 1e-2);
  EXPECT_NEAR(top_m(passage({{"maxheight", "default"}}), {}), 3.5f, 1e-3f);
  EXPECT_NEAR(top_m({{"railway", "tram"}, {"tunnel", "building_passage"}}, {}), 5.0f, 1e-3f);
  EXPECT_NEAR(top_m({{"highway", "footway"}, {"tunnel", "building_passage"}}, {}), 3.5f, 1e-3f);
  EXPECT_NEAR(top_m(passage(), [](dvec2) { return 40.0; }), 43.5f, 1e-3f);
}

TEST(OsmPassages, CourtyardsAreReachedThroughOneWing) {
  TestMap map;
  map.add_area_with_holes({{{0, 0}, {40, 0}, {40, 40}, {0, 40}}, {{10, 10}, {30, 10}, {30, 30}, {10, 30}}},
                          house_tags);
  map.add_line({{20, 0}, {20, 10}}, passage());
  const TestTown town = read(map);
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(area_m2(*town.model, ceiling), passage_width_m * 10.0, 0.1);
  expect_closed(*town.model, 1200.0 - passage_width_m * 10.0);
}

TEST(OsmPassages, WaysThatBendMeetAndRunAskewLeaveAClosedBuilding) {
  TestMap map;
  map.add_area({{0, 0}, {60, 5}, {55, 40}, {30, 30}, {-5, 45}}, house_tags);
  map.add_line({{10, 0.8}, {18, 15}, {30, 30}}, passage());
  map.add_line({{18, 15}, {40, 18}, {58, 20}}, passage({{"maxheight", "4"}}));
  map.add_line({{25, 16}, {25, 22}}, passage());  // ends inside
  const TestTown town = read(map);
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_EQ(town.warnings, "");
  const double open_m2 = area_m2(*town.model, ceiling);
  EXPECT_GT(open_m2, 250.0);
  EXPECT_LT(open_m2, 420.0);
  EXPECT_NEAR(bounds_of(*town.model, ceiling).min.z, 4.0f, 1e-3f) << "all as high as the highest";
  expect_closed(*town.model, directed_area_m2(*town.model, "RoofSurface").z - open_m2);
}

TEST(OsmPassages, WaysBesideAndUnderRaisedPartsCutNothing) {
  TestMap map;
  map.add_area(long_house, house_tags);
  map.add_line({{0, -3}, {20, -3}}, passage());
  map.add_area({{30, 0}, {50, 0}, {50, 10}, {30, 10}},
               {{"building", "yes"}, {"min_height", "4"}, {"height", "12"}});
  map.add_line({{40, 0}, {40, 10}}, passage());
  const TestTown town = read(map);
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(area_m2(*town.model, wall_surface), 60.0 * 12.0 + 60.0 * 8.0, 1.0);
  EXPECT_NEAR(bounds_of(*town.model, ceiling).min.z, 4.0f, 1e-3f);
}

TEST(OsmPassages, LowBuildingsStayWholeWithAWarning) {
  TestMap map;
  map.add_area(long_house, {{"building", "yes"}, {"height", "2.2"}});
  map.add_line({{10, 0}, {10, 10}}, passage());
  const TestTown town = read(map);
  ASSERT_TRUE(town.model);
  EXPECT_NE(town.warnings.find("way 1: its walls are 2.2 m high, too low for the passage"), std::string::npos)
      << town.warnings;
  EXPECT_NEAR(area_m2(*town.model, wall_surface), 60.0 * 2.2, 0.5);
}

TEST(OsmPassages, ManyInOnePlaceAreLeftOutWithAWarning) {
  TestMap map;
  for (int i = 0; i < 20; ++i) map.add_area(long_house, house_tags);
  for (int i = 0; i < 2000; ++i) {
    const double x = 5.0 + 0.005 * i;
    map.add_line({{x, 0}, {20.0 - x, 10}}, passage());
  }
  const TestTown town = read(map);
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NE(town.warnings.find("way 1: more than 64 passages lead through it"), std::string::npos)
      << town.warnings;
}

TEST(OsmPassages, WallsInTheAirStandOnUndersides) {
  // What gives walls doors finds those in the air by the underside that begins at their foot.
  TestMap map;
  map.add_area({{0, 0}, {6, 0}, {6, 20}, {0, 20}},
               {{"building", "bridge"}, {"min_height", "5"}, {"height", "9"}});
  const TestTown town = read(map);
  ASSERT_TRUE(town.model);
  std::vector<glm::vec3> undersides;
  for (const Part& part : town.model->parts)
    if (part.object == ceiling)
      undersides.insert(undersides.end(), part.mesh.positions.begin(), part.mesh.positions.end());
  std::size_t feet = 0;
  for (const Part& part : town.model->parts)
    for (const glm::vec3& p : part.mesh.positions) {
      if (!part.object.starts_with(wall_surface) || p.z > 5.01f) continue;
      ++feet;
      EXPECT_TRUE(std::ranges::find(undersides, p) != undersides.end());
    }
  EXPECT_EQ(feet, 8u);
}

}  // namespace
}  // namespace parvis::scene
