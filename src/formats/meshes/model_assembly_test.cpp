#include "formats/meshes/model_assembly.h"

#include <gtest/gtest.h>

#include "formats/meshes/wheel.h"

namespace parvis::scene {
namespace {

/// Six times the volume that the triangles enclose: positive where they face outward.
float signed_volume(const Mesh& mesh) {
  float volume = 0.0f;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    volume += glm::dot(mesh.positions[mesh.indices[i]],
                       glm::cross(mesh.positions[mesh.indices[i + 1]], mesh.positions[mesh.indices[i + 2]]));
  return volume;
}

TEST(Wheel, HasTheSizeAskedForAndFacesOutward) {
  const WheelShape shape{.radius_m = 0.3f, .width_m = 0.2f, .rim_radius_m = 0.2f};
  const Model wheel = make_wheel(shape);
  const Bounds box = bounds(wheel);
  EXPECT_NEAR(box.size().x, 0.6f, 1e-4f);
  EXPECT_NEAR(box.size().y, 0.2f, 1e-4f);
  EXPECT_NEAR(box.size().z, 0.6f, 1e-4f);
  for (const Part& part : wheel.parts) EXPECT_TRUE(check(part.mesh, part.object)) << part.object;
  EXPECT_GT(signed_volume(wheel.parts[0].mesh), 0.0f);
}

TEST(ModelAssembly, MountedModelsStandOnTheirNode) {
  const Model wheel = make_wheel({});
  Model car;
  car.materials = {{.name = "body"}};
  car.nodes[0].rotation = glm::angleAxis(glm::half_pi<float>(), glm::vec3(1, 0, 0));  // as glTF files have it
  mount(car, wheel, {.name = "wheel_left", .position = {1, 2, 3}});
  mount(car, wheel, {.name = "wheel_right", .position = {1, -2, 3}, .rotation = {0, 0, 0, 1}, .scale = 2.0f});
  EXPECT_EQ(car.parts.size(), 2 * wheel.parts.size());
  const Bounds box = bounds(car);
  EXPECT_NEAR(box.min.z, 3.0f - 0.62f, 1e-4f);
  EXPECT_NEAR(box.max.y, 2.1f, 1e-4f);
  for (const Part& part : car.parts) {
    EXPECT_LT(std::size_t(part.material), car.materials.size());
    EXPECT_NE(car.materials[std::size_t(part.material)].name, "body");
  }
  for (std::size_t i = 0; i < car.nodes.size(); ++i) EXPECT_LT(car.nodes[i].parent, int(i));
}

TEST(ModelAssembly, PlacedTurnsThenScalesThenMoves) {
  Model model;
  model.materials = {{}};
  model.parts = {{.object = "", .mesh = {{{1, 0, 0}, {2, 0, 0}, {1, 0, 1}}, {}, {}, {0, 1, 2}, {}, {}}}};
  const glm::quat left = glm::angleAxis(glm::half_pi<float>(), glm::vec3(0, 0, 1));
  const Bounds box = bounds(placed(model, {10, 0, 0}, left, 2.0f));
  EXPECT_LT(glm::length(box.min - glm::vec3(10, 2, 0)), 1e-5f);
  EXPECT_LT(glm::length(box.max - glm::vec3(10, 4, 2)), 1e-5f);
}

}  // namespace
}  // namespace parvis::scene
