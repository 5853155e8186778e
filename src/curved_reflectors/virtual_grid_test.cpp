#include "curved_reflectors/virtual_grid.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/test_scene.h"

namespace parvis::curved_reflectors {
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
  grid.interpolate(corners, shown);
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
  grid.interpolate(corners, shown);
  const auto lost = std::ranges::count_if(shown, [](const VirtualPoint& point) { return point.is_lost; });
  EXPECT_GT(lost, 0);
  EXPECT_LT(lost, std::ptrdiff_t(vertices.size()) / 2);
}

TEST(VirtualGrid, StandsDegenerateMeshes) {
  EXPECT_TRUE(VirtualGrid({}, 0.1f).corners().empty());
  const std::vector<glm::vec3> one{{1.0f, 2.0f, 3.0f}}, flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  EXPECT_EQ(VirtualGrid(one, 0.1f).cell_count(), 1u);
  EXPECT_EQ(VirtualGrid(flat, 0.0f).cell_count(), 1u);
  EXPECT_EQ(VirtualGrid(flat, 0.0f).corners().size(), 8u);
}

TEST(VirtualGridLevels, FollowTheAreaOfTheReflection) {
  const std::vector<glm::vec3> vertices = ball();
  const VirtualGridLevels levels(vertices);
  const VirtualGrid *small = levels.grid_for(100.0f),
                    *large = levels.grid_for(64.0f * 0.12f * float(vertices.size()));
  ASSERT_TRUE(small && large);
  EXPECT_LT(small->corners().size(), large->corners().size());
  EXPECT_EQ(levels.grid_for(1e9f), nullptr) << "every vertex is searched for";
}

}  // namespace
}  // namespace parvis::curved_reflectors
