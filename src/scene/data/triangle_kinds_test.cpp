#include "scene/data/triangle_kinds.h"

#include <gtest/gtest.h>

namespace parvis::scene {
namespace {

std::shared_ptr<const Model> model_of(std::size_t triangles) {
  auto model = std::make_shared<Model>();
  model->materials.emplace_back();
  Part part;
  part.mesh.positions.assign(3, glm::vec3(0.0f));
  part.mesh.indices.assign(3 * triangles, 0);
  model->parts.push_back(part);
  return model;
}

TEST(TriangleKinds, CountsAModelOncePerKindAndOncePerPlace) {
  Scene scene;
  const auto add = [&](const char* name, const std::shared_ptr<const Model>& model) {
    scene.objects.emplace_back();
    scene.objects.back().name = name, scene.objects.back().model = model;
  };
  const auto car = model_of(100), van = model_of(120);
  add("place", model_of(50));
  add("parked car 1", car), add("parked car 2", van), add("parked car 13", car);
  add("7", model_of(1));
  const std::vector<TriangleKind> kinds = triangle_kinds(scene);
  ASSERT_EQ(kinds.size(), 3u);
  EXPECT_EQ(kinds[0].name, "parked car");
  EXPECT_EQ(kinds[0].objects, 3u);
  EXPECT_EQ(kinds[0].stored, 220u);
  EXPECT_EQ(kinds[0].placed, 320u);
  EXPECT_EQ(kinds[1].name, "place");
  EXPECT_EQ(kinds[1].stored, 50u);
  EXPECT_EQ(kinds[2].name, "7") << "a name of digits alone stays";
}

}  // namespace
}  // namespace parvis::scene
