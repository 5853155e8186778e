#include "capture/trees/organs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "capture/trees/test_volume.h"

namespace parvis::trees {
namespace {

const glm::vec3 bark(0.12f, 0.08f, 0.05f), leaf_green(0.05f, 0.11f, 0.03f);
constexpr float trunk_radius_m = 0.06f, crown_from_m = 0.45f;

/// A column of bark with a ball of leaves round its upper half, and a branch out of it.
TreeVolume column_and_ball(glm::vec3 leaf_colour) {
  constexpr int side = 27;
  TreeVolume volume;
  std::vector<glm::u16vec3> cells;
  const Bounds box{{-0.5f, -0.5f, 0.0f}, {0.5f, 0.5f, 1.0f}};
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const glm::vec3 at = box.min + (glm::vec3(float(x), float(y), float(z)) + 0.5f) / float(side);
        const bool is_trunk = glm::length(glm::vec2(at)) < trunk_radius_m && at.z < 0.8f;
        const bool is_branch =
            at.x > 0.0f && at.x < 0.3f && std::abs(at.y) < 0.03f && std::abs(at.z - 0.6f) < 0.03f;
        const bool is_leaf = glm::distance(at, glm::vec3(0, 0, 0.72f)) < 0.27f;
        if (!is_trunk && !is_branch && !is_leaf) continue;
        cells.emplace_back(x, y, z);
        volume.colour.push_back((is_trunk || is_branch ? bark : leaf_colour) * (0.7f + 0.5f * at.z));
        volume.extinction_per_m.push_back(is_trunk ? 200.0f : is_branch ? 60.0f : 8.0f);
      }
  volume.grid = CellGrid(box, 3, side, std::move(cells));
  return volume;
}

TEST(Organs, AreDistinguishedByColourAndPlace) {
  const TreeVolume volume = column_and_ball(leaf_green);
  const Organs organs = organs_of(volume);
  std::size_t right = 0;
  for (std::size_t i = 0; i < volume.grid.size(); ++i) {
    const bool is_green = volume.colour[i].y > volume.colour[i].x;
    const bool is_in_trunk = glm::length(glm::vec2(volume.grid.centre(i))) < trunk_radius_m;
    const Organ truth = is_green ? Organ::leaf : is_in_trunk ? Organ::trunk : Organ::branch;
    right += organs.of_cell[i] == truth;
  }
  EXPECT_GT(double(right), 0.93 * double(volume.grid.size()));
  EXPECT_GT(organs.share(volume, Organ::trunk), 0.4f);
  EXPECT_NEAR(organs.share(volume, Organ::trunk) + organs.share(volume, Organ::branch) +
                  organs.share(volume, Organ::leaf),
              1.0f, 1e-4f);
}

TEST(Organs, TheTrunkIsFollowedFromTheFoot) {
  const Trunk trunk = organs_of(column_and_ball(leaf_green)).trunk;
  ASSERT_GE(trunk.rings.size(), 10u);
  for (const Trunk::Ring& ring : trunk.rings) {
    EXPECT_LT(glm::length(glm::vec2(ring.centre)), 0.03f);
    EXPECT_NEAR(ring.radius_m, trunk_radius_m, 0.3f * trunk_radius_m);
  }
  EXPECT_NEAR(trunk.rings.front().centre.z, 0.0f, 0.01f);
  EXPECT_GT(trunk.rings.back().centre.z, crown_from_m);
  EXPECT_LT(trunk.rings.back().centre.z, 0.85f);
}

TEST(Organs, ABareTreeHasNoLeaves) {
  TreeVolume volume = column_and_ball(leaf_green);
  for (glm::vec3& colour : volume.colour) colour = bark;
  const Organs organs = organs_of(volume);
  EXPECT_EQ(organs.share(volume, Organ::leaf), 0.0f);
  EXPECT_FALSE(organs.trunk.rings.empty());
}

TEST(Organs, ACrownOnTheGroundHasNoTrunk) {
  TreeVolume volume = column_and_ball(leaf_green);
  for (glm::vec3& colour : volume.colour) colour = leaf_green;
  const Organs organs = organs_of(volume);
  EXPECT_TRUE(organs.trunk.rings.empty());
  EXPECT_FALSE(trunk_shape(organs, {}));
}

TEST(Organs, WithoutTheTrunkTheRestIsLeft) {
  const TreeVolume volume = column_and_ball(leaf_green);
  const Organs organs = organs_of(volume);
  const TreeVolume rest = without(volume, organs, Organ::trunk);
  EXPECT_EQ(rest.grid.size(), std::size_t(std::ranges::count_if(
                                  organs.of_cell, [](Organ organ) { return organ != Organ::trunk; })));
  EXPECT_EQ(organs_of(rest).share(rest, Organ::trunk), 0.0f);
}

TEST(Organs, TheTrunkShowsItsPhotographs) {
  // Photographs that are red from the east, green as leaves from the north and blue from all other sides.
  Organs organs;
  organs.leaf_threshold = 0.12f;
  organs.trunk = {{{{0, 0, 0.6f}, 0.3f}, {{0, 0, 1.0f}, 0.3f}, {{0, 0, 1.4f}, 0.25f}}};
  std::vector<TreeView> views = TestVolume().ring(8, 64);
  for (TreeView& view : views) {
    const glm::vec3 eye = glm::normalize(view.camera.position_in_world);
    const int side = eye.x > 0.8f ? 0 : eye.y > 0.8f ? 1 : 2;
    for (std::size_t i = 0; i < view.picture.pixels.size(); ++i)
      view.picture.pixels[i] = i % 4 == 3 ? 255 : int(i % 4) == side ? 220 : 20;
  }
  const Result<TrunkShape> shape = trunk_shape(organs, views);
  ASSERT_TRUE(shape) << to_string(shape.errors());
  const Image8& bark_picture = shape->bark;
  const int middle = bark_picture.height / 2;
  EXPECT_GT(bark_picture.at(0, middle)[0], 180) << "texture coordinate 0 is in the east";
  EXPECT_GT(bark_picture.at(bark_picture.width / 2, middle)[2], 180);
  EXPECT_LT(bark_picture.at(bark_picture.width / 4, middle)[1], 40) << "no bark is as green as leaves";
  const scene::Model model = model_of(*shape);
  for (const glm::vec3& position : model.parts.front().mesh.positions)
    EXPECT_LE(glm::length(glm::vec2(position)), 0.301f);
}

TEST(Organs, AnErasedTrunkLeavesItsLeavesAndWhatIsBesideIt) {
  const TreeVolume volume = column_and_ball(leaf_green);
  const Organs organs = organs_of(volume);
  std::vector<TreeView> views = TestVolume().ring(8, 64);
  const glm::vec3 of_trunk(0.0f, 0.0f, 0.5f);
  for (TreeView& view : views)
    for (int y = 0; y < view.picture.height; ++y)
      for (int x = 0; x < view.picture.width; ++x) {
        // Bark all over, but for leaves in the picture's upper half.
        const bool is_leaf = float(y) < view.camera.project(of_trunk).y - 3.0f;
        const std::uint8_t pixel[]{std::uint8_t(is_leaf ? 40 : 120), std::uint8_t(is_leaf ? 120 : 90), 40,
                                   255};
        std::ranges::copy(pixel, view.picture.at(x, y));
      }
  erase_trunk(views, volume, organs);
  for (const TreeView& view : views) {
    const auto alpha_at = [&](glm::vec3 point) {
      const glm::ivec2 pixel(glm::floor(glm::vec2(view.camera.project(point))));
      return int(view.picture.at(pixel.x, pixel.y)[3]);
    };
    EXPECT_EQ(alpha_at(of_trunk), 0);
    const glm::vec3 aside = glm::normalize(glm::cross(view.camera.position_in_world, glm::vec3(0, 0, 1)));
    EXPECT_EQ(alpha_at(of_trunk + 0.05f * aside), 0) << "to its edge";
    EXPECT_EQ(alpha_at(of_trunk + 0.2f * aside), 255) << "beside it";
    EXPECT_EQ(alpha_at({0.0f, 0.0f, 0.7f}), 255) << "a leaf before it";
  }
}

}  // namespace
}  // namespace parvis::trees
