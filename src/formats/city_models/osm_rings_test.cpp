#include "formats/city_models/osm_rings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formats/city_models/osm_areas.h"
#include "formats/city_models/osm_buildings.h"
#include "formats/city_models/test_osm.h"

namespace parvis::scene {
namespace {

using glm::dvec2;

OsmRing block(double x, double y, double width, double depth) {
  return {{x, y}, {x + width, y}, {x + width, y + depth}, {x, y + depth}};
}

/// Area of all areas without their holes.
double enclosed_m2(const std::vector<std::vector<OsmRing>>& areas) {
  double sum = 0.0;
  for (const std::vector<OsmRing>& rings : areas)
    for (const OsmRing& ring : rings) sum += area_m2(ring);
  return sum;
}

void expect_simple(const std::vector<std::vector<OsmRing>>& areas) {
  for (const std::vector<OsmRing>& rings : areas)
    for (OsmRing ring : rings) {
      EXPECT_EQ(area_m2(ring) > 0.0, ring == rings.front()) << "outlines counter-clockwise, holes clockwise";
      std::ranges::sort(ring, [](dvec2 a, dvec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
      EXPECT_TRUE(std::ranges::adjacent_find(ring) == ring.end());
    }
}

TEST(OsmRings, HolesThatTouchTheOutlineInACornerAreHoles) {
  for (const std::size_t turn : {0u, 1u, 2u, 3u}) {
    OsmRing hole{{0, 0}, {4, 2}, {5, 5}, {2, 4}};
    std::ranges::rotate(hole, hole.begin() + std::ptrdiff_t(turn));
    std::size_t lost = 0;
    const auto areas = nested_rings({{block(0, 0, 10, 10)}, {hole, true}}, lost);
    ASSERT_EQ(areas.size(), 1u);
    EXPECT_EQ(areas[0].size(), 2u);
    EXPECT_NEAR(enclosed_m2(areas), 100.0 - std::abs(area_m2(hole)), 1e-9);
    expect_simple(areas);
  }
}

TEST(OsmRings, HolesWithACommonSideAreOne) {
  std::size_t lost = 0;
  const auto areas =
      nested_rings({{block(0, 0, 20, 10)}, {block(2, 2, 5, 6), true}, {block(7, 2, 4, 6), true}}, lost);
  ASSERT_EQ(areas.size(), 1u);
  ASSERT_EQ(areas[0].size(), 2u);
  EXPECT_NEAR(enclosed_m2(areas), 200.0 - 54.0, 1e-9);
  expect_simple(areas);
}

TEST(OsmRings, AHoleAlongTheOutlineIsANotch) {
  // The hole's corners lie on the outline's side, which has none there.
  std::size_t lost = 0;
  const auto areas = nested_rings({{block(0, 0, 20, 10)}, {block(5, 0, 6, 4), true}}, lost);
  ASSERT_EQ(areas.size(), 1u);
  EXPECT_EQ(areas[0].size(), 1u) << "open to the outside";
  EXPECT_NEAR(enclosed_m2(areas), 200.0 - 24.0, 1e-9);
  expect_simple(areas);
}

TEST(OsmRings, OutlinesThatTouchThemselvesHaveCourtyardsAndOutlinesThatShareASideAreOne) {
  // Round the block, and from its corner round the courtyard.
  std::size_t lost = 0;
  const auto pinched =
      nested_rings({{{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}, {3, 6}, {6, 6}, {6, 3}}}}, lost);
  ASSERT_EQ(pinched.size(), 1u);
  EXPECT_EQ(pinched[0].size(), 2u);
  EXPECT_NEAR(enclosed_m2(pinched), 100.0 - std::abs(area_m2({{0, 0}, {3, 6}, {6, 6}, {6, 3}})), 1e-9);
  expect_simple(pinched);
  const auto joined = nested_rings({{block(0, 0, 5, 5)}, {block(5, 0, 5, 5)}, {block(20, 0, 5, 5)}}, lost);
  EXPECT_EQ(joined.size(), 2u);
  EXPECT_NEAR(enclosed_m2(joined), 75.0, 1e-9);
  EXPECT_EQ(lost, 0u);
}

TEST(OsmRings, IslandsStandInCourtyardsAndCourtyardsWithoutAHouseAreLost) {
  std::size_t lost = 0;
  const auto areas = nested_rings(
      {{block(0, 0, 30, 30)}, {block(5, 5, 20, 20), true}, {block(10, 10, 5, 5)}, {block(50, 0, 5, 5), true}},
      lost);
  ASSERT_EQ(areas.size(), 2u);
  EXPECT_EQ(lost, 1u);
  EXPECT_NEAR(enclosed_m2(areas), 900.0 - 400.0 + 25.0, 1e-9);
}

/// Surface of parts of one name, upright ones among them.
double surface_m2(const Model& model, const std::string& name) {
  double sum = 0.0;
  for (const Part& part : model.parts)
    if (part.object.starts_with(name))
      for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
        const auto at = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
        sum += 0.5 * double(glm::length(glm::cross(at(1) - at(0), at(2) - at(0))));
      }
  return sum;
}

const TestTags flat_house{{"building", "yes"}, {"height", "8"}};

TEST(OsmRings, TagsOfTheOuterWayAloneLeaveTheCourtyardOpen) {
  for (const bool says_twice : {false, true}) {
    TestMap map;
    map.add_area(block(0, 0, 20, 20), flat_house);
    map.add_area(block(5, 5, 10, 10), {});
    TestTags tags{{"type", "multipolygon"}};
    if (says_twice) tags.insert(tags.end(), flat_house.begin(), flat_house.end());
    map.add_relation({{1, "outer"}, {2, "inner"}}, tags);
    const TestTown town = read(map);
    ASSERT_TRUE(town.model) << to_string(town.model.errors());
    EXPECT_EQ(town.warnings, "");
    EXPECT_NEAR(surface_m2(*town.model, "RoofSurface"), 300.0, 0.5) << says_twice;
    EXPECT_NEAR(surface_m2(*town.model, "WallSurface"), 8.0 * 120.0, 2.0) << says_twice;
  }
}

TEST(OsmRings, AHouseRoundWhichAnotherAreaIsDrawnStaysAHouse) {
  TestMap map;
  map.add_area(block(0, 0, 20, 20), flat_house);
  map.add_area(block(5, 5, 10, 10), {});
  map.add_relation({{1, "outer"}, {2, "inner"}}, {{"type", "multipolygon"}, {"landuse", "grass"}});
  const TestTown town = read(map);
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(surface_m2(*town.model, "RoofSurface"), 400.0, 0.5);
  EXPECT_NEAR(surface_m2(*town.model, "PlantCover"), 300.0, 0.5);
}

TEST(OsmRings, WaysThatAreNoAreasAreNoHouses) {
  TestMap map;
  map.add_area(block(0, 0, 20, 20), {{"building", "yes"}, {"area", "no"}});
  map.add_area(block(30, 0, 10, 10), flat_house);
  const TestTown town = read(map);
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(surface_m2(*town.model, "RoofSurface"), 100.0, 0.5);
  EXPECT_NE(town.warnings.find("way 1: a building with area=no"), std::string::npos) << town.warnings;
}

}  // namespace
}  // namespace parvis::scene
