// Roofs of maps on outlines with wings and on outlines that are drawn badly, by the reader of OpenStreetMap.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "formats/city_models/osm_areas.h"
#include "formats/city_models/test_osm.h"
#include "formats/city_models/test_rings.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::vec2, glm::vec3;

constexpr double eaves_m = 6.0;  // two levels

/// Buildings with these outlines, in metres; they are ways 1, 2, 3, ...
TestTown read(const std::vector<OsmRing>& outlines, const std::string& shape) {
  TestMap map;
  for (const OsmRing& outline : outlines)
    map.add_area(outline, {{"building", "yes"}, {"building:levels", "2"}, {"roof:shape", shape}});
  return scene::read(map);
}

constexpr const char* two_storey_walls = "WallSurface 2-storeys";  // as building:levels says

std::vector<vec3> positions(const Model& model, const std::string& object) {
  std::vector<vec3> found;
  for (const Part& part : model.parts)
    if (part.object == object)
      found.insert(found.end(), part.mesh.positions.begin(), part.mesh.positions.end());
  return found;
}

void expect_no_face_down(const Model& model, const std::string& object) {
  for (const Part& part : model.parts)
    for (std::size_t i = 0; part.object == object && i + 2 < part.mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
      EXPECT_GE(glm::cross(at(1) - at(0), at(2) - at(0)).z, -2e-4f) << object;
    }
}

/// The roof covers the outline once and lies between eaves and ridge, and the walls reach it.
void expect_house(const Model& model, double plan_m2, double ridge_m) {
  const glm::dvec3 roof_m2 = directed_area_m2(model, "RoofSurface"),
                   walls_m2 = directed_area_m2(model, two_storey_walls);
  expect_no_face_down(model, "RoofSurface"), expect_no_face_down(model, two_storey_walls);
  EXPECT_NEAR(roof_m2.z, plan_m2, 0.005 * plan_m2);
  EXPECT_NEAR(glm::length(roof_m2 + walls_m2 - glm::dvec3(0.0, 0.0, roof_m2.z)), 0.0, 0.02)
      << "open elsewhere than below";
  const std::vector<vec3> roof = positions(model, "RoofSurface");
  double highest_m = 0.0;
  for (const vec3& point : roof) {
    EXPECT_GE(double(point.z), eaves_m - 1e-3);
    highest_m = std::max(highest_m, double(point.z));
  }
  EXPECT_NEAR(highest_m, ridge_m, 0.02);
  for (const vec3& point : positions(model, two_storey_walls))
    EXPECT_TRUE(
        point.z < 1e-3f ||
        std::ranges::any_of(roof, [&](const vec3& other) { return glm::distance(point, other) < 1e-3f; }))
        << "the wall ends below the roof, at " << point.x << " " << point.y << " " << point.z;
}

constexpr double l_ridge_m = eaves_m + 0.6 * 2.5;  // over wings of 5 m

TEST(OsmWings, HipsStandOnThem) {
  const TestTown house = read({l_shape}, "hipped");
  ASSERT_TRUE(house.model) << to_string(house.model.errors());
  EXPECT_EQ(house.warnings, "");
  expect_house(*house.model, area_m2(l_shape), l_ridge_m);
  EXPECT_NEAR(area_m2(*house.model, two_storey_walls), 48.0 * eaves_m, 1.5) << "all walls end at the eaves";
}

TEST(OsmWings, GablesStandAtTheirEnds) {
  const TestTown house = read({l_shape}, "gabled");
  ASSERT_TRUE(house.model) << to_string(house.model.errors());
  EXPECT_EQ(house.warnings, "");
  expect_house(*house.model, area_m2(l_shape), l_ridge_m);
  EXPECT_NEAR(area_m2(*house.model, two_storey_walls), 48.0 * eaves_m + 2.0 * 0.5 * 5.0 * 1.5, 1.5);
}

TEST(OsmWings, PointsAlongSidesAndSpikesChangeNothing) {
  const OsmRing drawn_badly{{0, 0},       {3, 0.02}, {6, 0},  {12, 0}, {12, 0}, {12, 5}, {8, 5},
                            {5.001, 5.0}, {5, 5},    {5, 12}, {5, 19}, {5, 12}, {0, 12}, {0, 6}};
  for (const char* shape : {"hipped", "gabled"}) {
    const TestTown house = read({drawn_badly}, shape);
    ASSERT_TRUE(house.model) << to_string(house.model.errors());
    EXPECT_EQ(house.warnings, "");
    expect_house(*house.model, area_m2(l_shape), l_ridge_m);
  }
}

OsmRing star(int corners, double inner_m, double outer_m) {
  OsmRing ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    ring.push_back((i % 2 == 0 ? outer_m : inner_m) * dvec2(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

TEST(OsmWings, RoundHousesOfManyCornersHaveHips) {
  const OsmRing round = star(5000, 20.0, 20.0);
  const TestTown house = read({round}, "hipped");
  ASSERT_TRUE(house.model) << to_string(house.model.errors());
  EXPECT_EQ(house.warnings, "");
  expect_house(*house.model, area_m2(round), eaves_m + 0.6 * 19.95);  // sides pass corners by 5 cm
}

TEST(OsmWings, TooManyCornersAndCrossingSidesGiveFlatRoofsThatAreNamed) {
  const OsmRing crossed{{40, 0}, {50, 10}, {50, 0}, {40, 10}, {30, 5}};
  const TestTown town = read({star(5000, 15.0, 20.0), crossed, l_shape}, "gabled");
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NE(
      town.warnings.find("way 1 (gabled): drawn with a flat roof: its outline has more than 150 corners"),
      std::string::npos)
      << town.warnings;
  EXPECT_NE(town.warnings.find("way 2 (gabled): drawn with a flat roof: its outline crosses"),
            std::string::npos)
      << town.warnings;
  EXPECT_EQ(town.warnings.find("way 3"), std::string::npos) << town.warnings;
}

TEST(OsmWings, ManyFlatRoofsAreOneWarning) {
  std::vector<OsmRing> outlines;
  for (int i = 0; i < 30; ++i) {
    OsmRing& moved = outlines.emplace_back(l_shape);
    for (dvec2& corner : moved) corner.x += 15.0 * i;
  }
  const TestTown town = read(outlines, "mansard");
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NE(town.warnings.find("way 1 (mansard), way 2 (mansard), way 3 (mansard), way 4 (mansard), way 5 "
                               "(mansard) and 25 more: drawn with a flat roof"),
            std::string::npos)
      << town.warnings;
  EXPECT_EQ(std::ranges::count(town.warnings, '\n'), 1) << town.warnings;
}

}  // namespace
}  // namespace parvis::scene
