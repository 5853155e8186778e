#include "formats/meshes/polygon_ears.h"

#include <gtest/gtest.h>

#include <cmath>

namespace parvis::scene {
namespace {

/// The sum of the triangles' areas, each of which must run counter-clockwise.
double covered(const std::vector<glm::dvec2>& corners) {
  double area = 0.0;
  for (const auto& [a, b, c] : ears(corners)) {
    const double twice = twice_area(corners[a], corners[b], corners[c]);
    EXPECT_GE(twice, 0.0);
    area += twice / 2.0;
  }
  return area;
}

TEST(PolygonEars, CoverAnEvenLFromEachCornerOnce) {
  std::vector<glm::dvec2> corners{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (std::size_t first = 0; first < corners.size(); ++first) {
    EXPECT_TRUE(is_concave(corners));
    EXPECT_DOUBLE_EQ(covered(corners), 3.0) << first;
    std::ranges::rotate(corners, corners.begin() + 1);
  }
}

TEST(PolygonEars, CoverStarsCombsAndCornersOnStraightSides) {
  std::vector<glm::dvec2> star, comb;
  for (int i = 0; i < 10; ++i) {
    const double radius = i % 2 == 0 ? 2.0 : 1.0, turn = i * 0.62831853071795865;
    star.emplace_back(radius * std::cos(turn), radius * std::sin(turn));
  }
  EXPECT_NEAR(covered(star), 5.87785252, 1e-6);
  comb = {{0, 0}, {1, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1},
          {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  EXPECT_DOUBLE_EQ(covered(comb), 11.0);
  EXPECT_FALSE(is_concave({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}));
}

TEST(PolygonEars, CoverAPolygonWhoseHoleIsReachedByABridge) {
  EXPECT_DOUBLE_EQ(covered({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}}),
                   12.0);
}

TEST(PolygonEars, EndWhereAPolygonCrossesItselfOrIsFlat) {
  EXPECT_LE(ears({{0, 0}, {2, 2}, {2, 0}, {0, 2}}).size(), 2u);
  EXPECT_LE(ears({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1, 0}}).size(), 3u);
}

TEST(PolygonEars, LieInThePlaneOfWallsAndRoofs) {
  for (const glm::dvec3 up : {glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0)}) {
    const glm::dvec3 along = up.x != 0.0 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 across = glm::cross(up, along);
    std::vector<glm::dvec3> corners;
    for (const glm::dvec2 p : {glm::dvec2(0, 0), {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})
      corners.push_back(p.x * along + p.y * across);
    EXPECT_DOUBLE_EQ(covered(corners_in_plan(corners)), 3.0);
  }
}

}  // namespace
}  // namespace parvis::scene
