#include "scene/roads/paving.h"

#include <gtest/gtest.h>

#include "base/mesh.h"
#include "scene/roads/road_builder.h"

namespace parvis::scene {
namespace {

/// A slope that rises by a tenth to the east, and a roof 9 m above it.
Scene hillside() {
  auto model = std::make_shared<Model>();
  model->materials.emplace_back();
  for (const float lift : {0.0f, 9.0f}) {
    Part part;
    part.mesh.positions = {
        {-50, -50, -5 + lift}, {150, -50, 15 + lift}, {150, 50, 15 + lift}, {-50, 50, -5 + lift}};
    part.mesh.indices = {0, 1, 2, 0, 2, 3};
    model->parts.push_back(part);
  }
  Scene scene;
  scene.objects.emplace_back().model = model;
  Road road;
  road.path = {{0, 0, 1}, {100, 0, 9}};  // hardly right
  Road other;
  other.path = {{50, -40, 5}, {50, 40, 5}};
  scene.roads = *build_road_graph(std::vector{road, other});
  return scene;
}

TEST(Paving, LiesOnTheGround) {
  Scene scene = hillside();
  pave(scene);
  ASSERT_EQ(scene.objects.size(), 2u);
  for (const Part& part : scene.objects[1].model->parts) {
    EXPECT_TRUE(check(part.mesh, part.object).ok());
    for (const glm::vec3& p : part.mesh.positions) EXPECT_NEAR(p.z, 0.1f * p.x + 0.05f, 0.04f);
    for (const glm::vec3& n : part.mesh.normals) EXPECT_GT(n.z, 0.98f);
  }
  for (const Lane& lane : scene.roads.lanes)
    for (const glm::vec3& p : lane.points) EXPECT_NEAR(p.z, 0.1f * p.x + 0.06f, 0.03f);
}

TEST(Paving, HasMarkings) {
  Scene scene = hillside();
  pave(scene);
  EXPECT_EQ(scene.objects[1].model->parts.size(), 4u);
}

TEST(Paving, WithoutGroundLanesKeepTheirHeight) {
  Scene scene = hillside();
  scene.objects.clear();
  const float z = scene.roads.lanes[0].points[0].z;
  pave(scene);
  EXPECT_NEAR(scene.roads.lanes[0].points[0].z, z + 0.06f, 1e-4f);
}

TEST(Paving, NeedsRoads) {
  Scene scene = hillside();
  scene.roads = {};
  pave(scene);
  EXPECT_EQ(scene.objects.size(), 1u);
}

}  // namespace
}  // namespace parvis::scene
