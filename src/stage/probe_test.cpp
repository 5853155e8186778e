#include "stage/probe.h"

#include <gtest/gtest.h>

#include "scene/data/test_scene.h"

namespace parvis::stage {
namespace {

/// A house on level ground, seen from the south.
scene::Scene house_on_ground() {
  scene::Scene scene;
  scene::add(scene, scene::model_of(scene::ground(50), scene::matt(glm::vec3(0.3f))));
  auto house = scene::model_of(scene::box({-4, 10, 0}, {4, 16, 9}), scene::matt(glm::vec3(0.5f)));
  house->materials.front().name = "WallSurface";
  scene::add(scene, house);
  scene.objects.back().name = "town hall";
  return scene;
}

Camera from_the_south() {
  Camera camera;
  camera.world_from_camera = look_at({0, -10, 2}, {0, 10, 2});
  return camera;
}

TEST(Probe, GivesThePointTheObjectAndItsKind) {
  const scene::Scene scene = house_on_ground();
  const std::optional<ProbedPoint> point = probe(scene, from_the_south(), {201, 101}, {100, 50});
  ASSERT_TRUE(point);
  EXPECT_LT(glm::distance(point->position_in_world, glm::vec3(0, 10, 2)), 1e-3f);
  EXPECT_NEAR(point->distance_m, 20.0f, 1e-3f);
  EXPECT_EQ(point->name, "town hall");
  EXPECT_EQ(point->kind, "WallSurface");
  EXPECT_EQ(to_string(point, scene), "0.00 10.00 2.00 m, \"town hall\", WallSurface, 20.0 m away");
}

TEST(Probe, GivesMapCoordinatesWhereThereAreSome) {
  scene::Scene scene = house_on_ground();
  scene.origin = {500'000, 5'800'000, 30};
  const auto point = probe(scene, from_the_south(), {201, 101}, {100, 50});
  EXPECT_NE(to_string(point, scene).find("on the map 500000.00 5800010.00 32.00"), std::string::npos)
      << to_string(point, scene);
}

TEST(Probe, TheSkyIsNoPoint) {
  const scene::Scene scene = house_on_ground();
  EXPECT_FALSE(probe(scene, from_the_south(), {201, 101}, {5, 0}));
  EXPECT_FALSE(probe(scene, from_the_south(), {201, 101}, {500, 50})) << "outside the picture";
  EXPECT_EQ(to_string(std::nullopt, scene), "the sky");
}

}  // namespace
}  // namespace parvis::stage
