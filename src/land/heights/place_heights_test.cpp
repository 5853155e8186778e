#include "land/heights/place_heights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "scene/data/surroundings.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

constexpr float margin_m = 20.0f;

/// Houses without ground, every 20 m, on a slope of 8 % that rises eastward.
Scene houses_on_a_slope() {
  Scene scene;
  for (float x = 0.0f; x < 100.0f; x += 20.0f)
    for (float y = 0.0f; y < 60.0f; y += 20.0f) {
      auto house =
          model_of(box({x, y, 0.08f * x}, {x + 8.0f, y + 8.0f, 0.08f * x + 9.0f}), matt(glm::vec3(0.5f)));
      house->parts.front().object = "WallSurface";
      add(scene, house);
    }
  return scene;
}

TEST(PlaceHeights, RisesWithTheFeetOfHouses) {
  const Scene scene = houses_on_a_slope();
  const PlaceHeights place(scene, {}, margin_m);
  for (const float x : {12.0f, 34.0f, 52.0f, 74.0f})
    EXPECT_NEAR(place.at({x, 30.0f}), 0.08f * x, 1.2f) << "never up to the roofs, 9 m above";
  EXPECT_NEAR(place.at({-500.0f, 30.0f}), place.at({-margin_m, 30.0f}), 0.5f)
      << "beyond the plan as at its edge";
  for (const float height : place.heights().cells) EXPECT_TRUE(std::isfinite(height));
}

/// Houses of 8 m on level ground, 24 m from each other, of which some stand deeper.
Scene houses_of_which(const std::vector<glm::ivec2>& deep, float foot_m, float top_m) {
  Scene scene;
  for (int x = 0; x < 7; ++x)
    for (int y = 0; y < 7; ++y) {
      const bool is_deep = std::ranges::find(deep, glm::ivec2(x, y)) != deep.end();
      const glm::vec2 low = 24.0f * glm::vec2(x, y);
      auto house = model_of(box({low, is_deep ? foot_m : 0.0f}, {low + 8.0f, is_deep ? top_m : 9.0f}),
                            matt(glm::vec3(0.5f)));
      house->parts.front().object = "WallSurface";
      add(scene, house);
    }
  return scene;
}

TEST(PlaceHeights, OneHouseWithItsCellarIsNoPit) {
  const glm::vec2 in_middle(76.0f, 76.0f), beside(98.0f, 76.0f);
  const PlaceHeights place(houses_of_which({{3, 3}}, -3.5f, 9.0f), {}, margin_m);
  for (const glm::vec2 p : {in_middle, beside}) EXPECT_NEAR(place.at(p), 0.0f, 0.05f) << p.x;
  const PlaceHeights buried(houses_of_which({{3, 3}}, -3.5f, 0.5f), {}, margin_m);
  EXPECT_NEAR(buried.at(in_middle), -3.5f, 0.5f) << "control: it would vanish in the ground";
  const PlaceHeights dip(houses_of_which({{3, 3}, {4, 3}, {3, 4}}, -3.5f, 9.0f), {}, margin_m);
  EXPECT_NEAR(dip.at(in_middle), -3.5f, 0.5f) << "control: where several are as low, the ground is";
}

TEST(PlaceHeights, CellarsAndFoundationsAreNoFeet) {
  for (const bool is_known : {true, false}) {
    Scene scene;
    for (const auto& [low_m, high_m, name] : {std::tuple(0.0f, 9.0f, "IfcWall Render"),
                                              std::tuple(-3.0f, 0.0f, "IfcWall Concrete below ground")}) {
      auto storey = model_of(box({0, 0, low_m}, {12, 12, high_m}), matt(glm::vec3(0.5f)));
      storey->parts.front().object = is_known ? name : "IfcWall";
      add(scene, storey);
    }
    const PlaceHeights place(scene, {}, margin_m);
    EXPECT_NEAR(place.at({6.0f, 25.0f}), is_known ? 0.0f : -3.0f, 0.05f);
  }
}

TEST(PlaceHeights, OwnGroundIsTakenAsItIs) {
  Scene scene;
  auto ground = model_of(quad({0, 0, 3}, {60, 0, 3}, {60, 40, 5}, {0, 40, 5}), matt(glm::vec3(0.5f)));
  ground->parts.front().object = "LandUse";
  add(scene, ground);
  const PlaceHeights place(scene, {}, margin_m);
  EXPECT_NEAR(place.at({30.0f, 20.0f}), 4.0f, 0.05f);
  const glm::ivec2 inside = place.own_ground().cell_at({30.0f, 20.0f}),
                   outside = place.own_ground().cell_at({-15.0f, 20.0f});
  EXPECT_EQ(place.own_ground().at(inside.x, inside.y), 1);
  EXPECT_EQ(place.own_ground().at(outside.x, outside.y), 0);
  EXPECT_NEAR(place.at({-15.0f, 20.0f}), 4.0f, 1.0f) << "goes on where the file's ends";
}

TEST(PlaceHeights, RoadsLieOnTheGround) {
  Scene scene;
  const std::vector<Road> roads{{.path = {{0, 0, 10}, {100, 0, 12}}, .where = {}, .name = ""}};
  const PlaceHeights place(scene, roads, margin_m);
  EXPECT_NEAR(place.at({50.0f, 0.0f}), 11.0f, 0.1f);
}

/// A model in the coordinates of its map stands beside one about the origin: cells of metres would fill the
/// memory.
TEST(PlaceHeights, AModelThousandsOfKilometresAwayTakesNoMemoryForTheWayThere) {
  Scene scene;
  for (const float away_m : {0.0f, 4e6f})
    add(scene, model_of(box({away_m, away_m, 5}, {away_m + 12, away_m + 12, 14}), matt(glm::vec3(0.5f))));
  const PlaceHeights place(scene, {}, margin_m);
  for (const float at_m : {0.0f, 4e6f}) EXPECT_NEAR(place.at({at_m, at_m}), 5.0f, 0.1f) << at_m;
}

TEST(PlaceHeights, NothingAtAllIsLevel) { EXPECT_EQ(PlaceHeights({}, {}, margin_m).at({5.0f, 5.0f}), 0.0f); }

TEST(PlaceHeights, LeavesOutWhatSurroundsThePlace) {
  Scene scene = houses_on_a_slope();
  const int land = add(scene, model_of(ground(6000.0f), matt(glm::vec3(0.5f))));
  const PlaceHeights wide(scene, {}, margin_m);
  scene.data<ItemsOf<Surroundings>>().add({scene.objects[std::size_t(land)].model}, 0);
  const PlaceHeights place(scene, {}, margin_m);
  EXPECT_GT(wide.heights().cell_m * float(wide.heights().width), 10'000.0f);
  EXPECT_LT(place.heights().cell_m * float(place.heights().width), 200.0f);
}

}  // namespace
}  // namespace parvis::scene
