#include "places/paper_city/facades.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/mesh.h"
#include "places/paper_city/brick_texture.h"

namespace parvis::city {
namespace {

void add_quad(Mesh& mesh, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
  const std::uint32_t first = std::uint32_t(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
  mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

/// Two walls that meet at a corner, and a roof, in one part.
scene::Model house(float width, float height) {
  scene::Model model;
  model.materials.emplace_back();
  scene::Part part;
  part.object = "building";
  add_quad(part.mesh, {0, 0, 2}, {width, 0, 2}, {width, 0, 2 + height}, {0, 0, 2 + height});
  add_quad(part.mesh, {width, 0, 2}, {width, 9, 2}, {width, 9, 2 + height}, {width, 0, 2 + height});
  add_quad(part.mesh, {0, 0, 2 + height}, {width, 0, 2 + height}, {width, 9, 2 + height}, {0, 9, 2 + height});
  fill_normals(part.mesh);
  part.mesh.uvs.resize(part.mesh.positions.size());
  model.parts.push_back(std::move(part));
  return model;
}

TEST(Facades, HoldWholeBaysAndStoreys) {
  scene::Model model = house(12.2f, 9.0f);
  EXPECT_EQ(add_facades(model, "build*"), 4u);
  ASSERT_EQ(model.parts.size(), 2u);  // the roof, and walls of one kind of brick
  EXPECT_EQ(model.parts[0].mesh.triangle_count(), 2u);
  const Mesh& walls = model.parts[1].mesh;
  EXPECT_TRUE(check(walls, "walls").ok());
  for (const glm::vec2& uv : walls.uvs) {
    EXPECT_NEAR(uv.x * brick_bays, std::round(uv.x * brick_bays), 1e-3f);
    EXPECT_NEAR(uv.y * brick_storeys, std::round(uv.y * brick_storeys), 1e-3f);
  }
  EXPECT_EQ(model.materials[std::size_t(model.parts[1].material)].name, "facade");
}

TEST(Facades, SmallWallsArePlain) {
  scene::Model model = house(12.0f, 1.5f);
  add_facades(model, "*");
  EXPECT_EQ(model.materials[std::size_t(model.parts[1].material)].name, "brick wall");
}

TEST(Facades, WithoutWallsNothingChanges) {
  scene::Model model = house(8.0f, 6.0f);
  EXPECT_EQ(add_facades(model, "no such name"), 0u);
  EXPECT_EQ(model.parts.size(), 1u);
  EXPECT_TRUE(model.textures.empty());
}

TEST(BrickWalls, RepeatWithoutASeam) {
  // Neighbours across the border differ no more than neighbours elsewhere do on average.
  const Image8 image = brick_wall_pictures(true, 1).colours[0];
  const auto difference = [&](int left, int right) {
    float sum = 0.0f;
    for (int y = 0; y < image.height; ++y)
      sum += std::abs(float(image.at(left, y)[0]) - float(image.at(right, y)[0]));
    return sum / float(image.height);
  };
  float inside = 0.0f;
  for (int x = 0; x < 60; ++x) inside = std::max(inside, difference(x, x + 1));
  EXPECT_LE(difference(image.width - 1, 0), 1.2f * inside);
}

}  // namespace
}  // namespace parvis::city
