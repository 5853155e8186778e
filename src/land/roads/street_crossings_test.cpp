#include "land/roads/street_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "land/roads/road_builder.h"

namespace parvis::scene {
namespace {

/// Two streets with two lanes of 3.5 m each that cross at the origin.
Scene crossroads() {
  Scene scene;
  Road east, north;
  east.path = {{-80, 0, 0}, {80, 0, 0}}, north.path = {{0, -80, 0}, {0, 80, 0}};
  east.lane_width_m = north.lane_width_m = 3.5f;
  scene.roads = *build_road_graph(std::vector<Road>{east, north});
  return scene;
}

/// Distances of the crossings' middles from the origin, in order.
std::vector<float> distances(const std::vector<StreetCrossing>& crossings) {
  std::vector<float> result;
  for (const StreetCrossing& crossing : crossings)
    result.push_back(glm::length(0.5f * (crossing.a + crossing.b)));
  std::ranges::sort(result);
  return result;
}

TEST(StreetCrossings, LieAcrossAllLanesOfEveryStreetAtAJunction) {
  const std::vector<StreetCrossing> crossings = street_crossings(crossroads());
  ASSERT_EQ(crossings.size(), 4u);
  for (const StreetCrossing& crossing : crossings) {
    EXPECT_NEAR(glm::distance(crossing.a, crossing.b), 7.0f, 0.1f);
    const glm::vec2 middle = 0.5f * (crossing.a + crossing.b);
    EXPECT_LT(std::min(std::abs(middle.x), std::abs(middle.y)), 0.1f) << "on the middle of its street";
    EXPECT_TRUE(crossing.contains(middle));
    EXPECT_FALSE(crossing.contains(glm::vec2(0.0f)));
  }
  EXPECT_GT(distances(crossings).front(), 5.0f) << "outside of the junction";
  EXPECT_LT(distances(crossings).back(), 14.0f);
}

TEST(StreetCrossings, LieOnThePaintOfZebras) {
  Scene scene = crossroads();
  auto model = std::make_shared<Model>();
  model->materials.resize(1), model->materials[0].name = "zebra_wide";
  Part part;
  part.mesh.positions = {{15, -3.5f, 0}, {19, -3.5f, 0}, {19, 3.5f, 0}, {15, 3.5f, 0}};
  part.mesh.indices = {0, 1, 2, 0, 2, 3};
  model->parts.push_back(std::move(part));
  Object object;
  object.model = std::move(model);
  scene.objects.push_back(std::move(object));
  EXPECT_NEAR(distances(street_crossings(scene)).back(), 17.0f, 0.2f);
}

TEST(StreetCrossings, AStreetWithoutAJunctionHasNone) {
  Scene scene;
  Road alone;
  alone.path = {{-80, 0, 0}, {80, 0, 0}};
  scene.roads = *build_road_graph(std::vector<Road>{alone});
  EXPECT_TRUE(street_crossings(scene).empty());
  EXPECT_TRUE(street_crossings({}).empty());
}

}  // namespace
}  // namespace parvis::scene
