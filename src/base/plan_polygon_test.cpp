#include "base/plan_polygon.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/glm.hpp>

#include "base/random.h"

namespace parvis {
namespace {

/// An L.
const std::vector<glm::dvec2> ring{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};

bool is_in_l(glm::dvec2 p) { return p.x > 0 && p.y > 0 && ((p.x < 4 && p.y < 1) || (p.x < 1 && p.y < 3)); }

TEST(PlanPolygon, PointsAreInsideWhereBothRectanglesOfAnLSaySo) {
  Random random(5);
  int inside = 0;
  const std::vector<glm::dvec2> clockwise(ring.rbegin(), ring.rend());
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec2 p(random.uniform(-1.0f, 5.0f), random.uniform(-1.0f, 4.0f));
    EXPECT_EQ(is_in_ring(ring, p), is_in_l(p)) << p.x << " " << p.y;
    EXPECT_EQ(is_in_ring(clockwise, p), is_in_l(p));
    inside += is_in_l(p);
  }
  EXPECT_GT(inside, 200);
  EXPECT_FALSE(is_in_ring(std::vector<glm::dvec2>{}, glm::dvec2(0.0)));
}

TEST(PlanPolygon, TrianglesHoldTheirSidesWhicheverWayTheyTurn) {
  std::array<glm::vec3, 3> triangle{glm::vec3(0, 0, 7), glm::vec3(2, 0, 8), glm::vec3(0, 2, 9)};
  for (int turn = 0; turn < 2; ++turn, std::swap(triangle[0], triangle[1])) {
    EXPECT_TRUE(is_in_triangle(triangle, glm::vec2(0.5f, 0.5f)));
    EXPECT_TRUE(is_in_triangle(triangle, glm::vec2(1.0f, 1.0f))) << "on a side";
    EXPECT_FALSE(is_in_triangle(triangle, glm::vec2(1.1f, 1.0f)));
    EXPECT_FALSE(is_in_triangle(triangle, glm::vec2(-0.1f, 0.5f)));
  }
  EXPECT_EQ(twice_area(triangle[0], triangle[1], triangle[2]), 4.0f);
}

TEST(PlanPolygon, ALineCrossesARingAndItsHole) {
  const std::vector<std::vector<glm::dvec2>> rings{ring,
                                                   {{0.25, 0.25}, {0.25, 0.75}, {0.75, 0.75}, {0.75, 0.25}}};
  using Ring = std::vector<glm::dvec2>;
  EXPECT_EQ(crossings_of_line(std::span<const Ring>(rings), 0.5),
            (std::vector<double>{0.0, 0.25, 0.75, 4.0}));
  EXPECT_EQ(crossings_of_line(std::span<const Ring>(rings), 2.0), (std::vector<double>{0.0, 1.0}));
  EXPECT_TRUE(crossings_of_line(std::span<const Ring>(rings), 3.5).empty());
}

}  // namespace
}  // namespace parvis
