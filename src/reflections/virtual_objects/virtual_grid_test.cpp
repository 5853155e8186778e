#include "reflections/virtual_objects/virtual_grid.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/data/test_scene.h"

namespace parvis::virtual_objects {
namespace {

std::vector<glm::vec3> ball() { return scene::sphere({3.0f, -1.0f, 2.0f}, 0.7f, 40).positions; }

TEST(VirtualGrid, HasNoMoreCornersThanItsShare) {
  const std::vector<glm::vec3> vertices = ball();
  std::size_t last = 0;
  for (const float share : {0.041f, 0.055f, 0.096f, 0.143f}) {
    const VirtualGrid grid(vertices, share);
    EXPECT_LE(grid.corners().size(), std::size_t(share * float(vertices.size())));
    EXPECT_GE(grid.corners().size(), last) << "a larger share is a finer grid, if there is one";
    last = grid.corners().size();
  }
}

/// Trilinear interpolation gives back what is linear, and so each vertex's own place.
TEST(VirtualGrid, GivesBackWhatIsLinear) {
  const std::vector<glm::vec3> vertices = ball();
  const VirtualGrid grid(vertices, 0.1f);
  const glm::mat3 linear(0.3f, 1.0f, -0.2f, 0.5f, 0.1f, 0.9f, -0.7f, 0.4f, 0.6f);
  std::vector<VirtualPoint> corners, shown(vertices.size());
  for (const glm::vec3& corner : grid.corners()) corners.push_back({linear * corner + 2.0f});
  grid.interpolate(vertices, corners, shown);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    EXPECT_LT(glm::distance(shown[i].position, linear * vertices[i] + 2.0f), 1e-4f);
    EXPECT_FALSE(shown[i].is_lost);
  }
}

TEST(VirtualGrid, LosesTheVerticesOfALostCornerAlone) {
  const std::vector<glm::vec3> vertices = ball();
  const VirtualGrid grid(vertices, 0.1f);
  std::vector<VirtualPoint> corners(grid.corners().size()), shown(vertices.size());
  corners.front().is_lost = true;
  grid.interpolate(vertices, corners, shown);
  const auto lost = std::ranges::count_if(shown, [](const VirtualPoint& point) { return point.is_lost; });
  EXPECT_GT(lost, 0);
  EXPECT_LT(lost, std::ptrdiff_t(vertices.size()) / 2);
}

TEST(VirtualGrid, StandsDegenerateMeshes) {
  EXPECT_TRUE(VirtualGrid({}, 0.1f).corners().empty());
  const std::vector<glm::vec3> one{{1.0f, 2.0f, 3.0f}}, flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  EXPECT_EQ(VirtualGrid(one, 0.1f).corners().size(), 8u);
  EXPECT_EQ(VirtualGrid(flat, 0.0f).corners().size(), 8u);
}

TEST(VirtualGrid, KnowsItsCornersByTheirPlaceInTheBox) {
  const VirtualGrid grid(ball(), 0.1f);
  const GridLayout& layout = grid.layout();
  std::size_t known = 0;
  ASSERT_EQ(grid.numbers_in_box().size(), layout.box_size());
  for (int z = 0; z <= layout.count.z; ++z)
    for (int y = 0; y <= layout.count.y; ++y)
      for (int x = 0; x <= layout.count.x; ++x) {
        const std::uint32_t number = grid.numbers_in_box()[layout.place_in_box({x, y, z})];
        if (number == VirtualGrid::no_corner) continue;
        ++known;
        EXPECT_LT(glm::distance(grid.corners()[number], layout.origin + glm::vec3(x, y, z) * layout.cell),
                  1e-5f);
      }
  EXPECT_EQ(known, grid.corners().size());
}

TEST(GridLevel, FollowsTheAreaOfTheReflection) {
  const std::array<std::uint32_t, 3> corners{140, 90, 40};
  EXPECT_EQ(grid_level(corners, 1000, 64.0f * 39.0f), 2u);
  EXPECT_EQ(grid_level(corners, 1000, 64.0f * 41.0f), 1u);
  EXPECT_EQ(grid_level(corners, 1000, 64.0f * 500.0f), 0u) << "the finest that there is";
  EXPECT_FALSE(grid_level(corners, 1000, 64.0f * 1001.0f)) << "every vertex is searched for";
  EXPECT_FALSE(grid_level({}, 1000, 1.0f));
}

}  // namespace
}  // namespace parvis::virtual_objects
