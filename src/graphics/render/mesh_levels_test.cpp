#include "graphics/render/mesh_levels.h"

#include <gtest/gtest.h>

#include <set>

#include "scene/data/test_scene.h"

namespace parvis::render {
namespace {

TEST(MeshLevels, OfABallHaveEverFewerTrianglesAndKnowHowFarTheyAreOff) {
  const Mesh ball = scene::sphere({1, 2, 3}, 2.0f, 64);
  const std::vector<MeshLevel> levels = coarser_levels(ball);
  ASSERT_GE(levels.size(), 4U);
  std::size_t finer = ball.indices.size();
  float error_m = 0.0f;
  for (const MeshLevel& level : levels) {
    EXPECT_LE(level.indices.size(), finer / 4 * 3);
    EXPECT_GE(level.error_m, error_m);
    finer = level.indices.size();
    error_m = level.error_m;
    float farthest_m = 0.0f;  // of the middles of triangles: their corners are the ball's
    for (std::size_t i = 0; i < level.indices.size(); i += 3) {
      glm::vec3 middle(0.0f);
      for (std::size_t corner = 0; corner < 3; ++corner)
        middle += ball.positions[level.indices[i + corner]] / 3.0f;
      farthest_m = std::max(farthest_m, 2.0f - glm::distance(middle, {1, 2, 3}));
    }
    // Quadrics tell the mean over the planes that met in a corner.
    EXPECT_LT(farthest_m, 3.0f * level.error_m + 0.005f);
  }
  EXPECT_GT(levels.back().error_m, 0.01f);
}

TEST(MeshLevels, AFlatSheetLosesNothingButTriangles) {
  Mesh sheet;
  constexpr std::uint32_t side = 40;
  for (std::uint32_t y = 0; y <= side; ++y)
    for (std::uint32_t x = 0; x <= side; ++x) {
      sheet.positions.emplace_back(x, y, 0.0f);
      sheet.normals.emplace_back(0.0f, 0.0f, 1.0f);
      sheet.uvs.emplace_back(x, y);
      if (x == side || y == side) continue;
      const std::uint32_t i = y * (side + 1) + x;
      for (const std::uint32_t corner : {i, i + 1, i + side + 2, i, i + side + 2, i + side + 1})
        sheet.indices.push_back(corner);
    }
  for (const MeshLevel& level : coarser_levels(sheet)) {
    float area_m2 = 0.0f;
    for (std::size_t i = 0; i < level.indices.size(); i += 3) {
      const glm::vec3 a = sheet.positions[level.indices[i]];
      area_m2 +=
          0.5f *
          glm::cross(sheet.positions[level.indices[i + 1]] - a, sheet.positions[level.indices[i + 2]] - a).z;
    }
    if (level.error_m > 1e-3f) break;
    EXPECT_NEAR(area_m2, float(side * side), 1.0f);
  }
}

TEST(MeshLevels, FewTrianglesAreLeftAsTheyAre) {
  EXPECT_TRUE(coarser_levels(Mesh{}).empty());
  EXPECT_TRUE(coarser_levels(scene::box({0, 0, 0}, {1, 1, 1})).empty());
}

}  // namespace
}  // namespace parvis::render
