#include "places/dressing/ground_cover.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/mesh.h"

namespace parvis::dressing {
namespace {

/// A grid of 21 x 21 points, a metre apart, with one pulled up to the top of a tree.
scene::Model green_with_a_spike(float spike_m) {
  scene::Model model;
  model.materials.emplace_back();
  scene::Part part;
  part.object = "PlantCover";
  constexpr int side = 21;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const float slope_m = 0.02f * float(x);
      part.mesh.positions.emplace_back(x, y, x == 10 && y == 10 ? spike_m : slope_m);
    }
  for (std::uint32_t y = 0; y + 1 < side; ++y)
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t a = y * side + x;
      part.mesh.indices.insert(part.mesh.indices.end(), {a, a + 1, a + side, a + 1, a + side + 1, a + side});
    }
  fill_normals(part.mesh);
  part.mesh.uvs.resize(part.mesh.positions.size());
  model.parts.push_back(std::move(part));
  return model;
}

TEST(Greenery, ASpikeBecomesATreeOfItsHeight) {
  scene::Model model = green_with_a_spike(9.0f);
  EXPECT_EQ(add_greenery(model, "PlantCover", 1), 1u);
  EXPECT_LT(model.parts[0].mesh.bounds().max.z, 0.5f);
  ASSERT_EQ(model.parts.size(), 3u);  // the lawn, wood, leaves
  const Bounds crown = model.parts[2].mesh.bounds();
  EXPECT_NEAR(crown.max.z, 9.0f, 1.8f);
  EXPECT_NEAR(0.5f * (crown.min.x + crown.max.x), 10.0f, 1.5f);
  for (const scene::Part& part : model.parts) EXPECT_TRUE(check(part.mesh, part.object).ok());
  EXPECT_EQ(model.materials[std::size_t(model.parts[0].material)].name, "lawn");
}

TEST(Greenery, LowGreenKeepsItsShape) {
  scene::Model model = green_with_a_spike(0.8f);
  EXPECT_EQ(add_greenery(model, "PlantCover", 1), 0u);
  EXPECT_FLOAT_EQ(model.parts[0].mesh.bounds().max.z, 0.8f);
}

TEST(Greenery, WithoutGreenNothingChanges) {
  scene::Model model = green_with_a_spike(9.0f);
  EXPECT_EQ(add_greenery(model, "no such name", 1), 0u);
  EXPECT_TRUE(model.textures.empty());
}

TEST(GroundCover, LiesInMetres) {
  for (const std::string& cover : ground_covers()) {
    scene::Model model = green_with_a_spike(0.0f);
    ASSERT_EQ(add_ground_cover(model, "*", cover), 1u);
    const Mesh& mesh = model.parts[0].mesh;
    const glm::vec2 per_m = mesh.uvs[1] - mesh.uvs[0];
    EXPECT_GT(per_m.x, 0.05f);
    EXPECT_EQ(per_m.y, 0.0f);
    EXPECT_FLOAT_EQ(mesh.uvs[21].y - mesh.uvs[0].y, -per_m.x);  // the picture's top lies north
  }
  scene::Model model = green_with_a_spike(0.0f);
  EXPECT_EQ(add_ground_cover(model, "*", "marble"), 0u);
}

}  // namespace
}  // namespace parvis::dressing
