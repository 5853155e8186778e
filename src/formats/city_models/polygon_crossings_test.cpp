#include "formats/city_models/polygon_crossings.h"

#include <gtest/gtest.h>

#include <cmath>

namespace parvis::scene {
namespace {

using Ring = std::vector<glm::dvec3>;

/// Every `step`-th of `count` points of a circle; step 1 is the outline, larger ones cross themselves.
Ring star(int count, int step, double radius_m = 100.0, glm::dvec3 centre = glm::dvec3(0.0)) {
  Ring ring;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * 3.14159265358979 * double((std::int64_t(i) * step) % count) / double(count);
    ring.push_back(centre + radius_m * glm::dvec3(std::cos(angle), std::sin(angle), 0.0));
  }
  return ring;
}

constexpr glm::dvec3 up(0.0, 0.0, 1.0);

TEST(PolygonCrossings, OutlinesOfAnySizeAndHolesCanBeTriangulated) {
  EXPECT_TRUE(can_be_triangulated({star(100'000, 1)}, up));
  std::vector<Ring> rings{star(1000, 1, 1000.0)};
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 40; ++y) rings.push_back(star(8, 1, 2.0, {10.0 * x - 200.0, 10.0 * y - 200.0, 0.0}));
  EXPECT_TRUE(can_be_triangulated(rings, up));
}

TEST(PolygonCrossings, SlipsOfThePenAreForgiven) {
  Ring ring = star(1000, 1);
  std::swap(ring[10], ring[11]);
  std::swap(ring[500], ring[502]);
  EXPECT_TRUE(can_be_triangulated({ring}, up));
}

TEST(PolygonCrossings, StarsAndEqualHolesAreNot) {
  EXPECT_TRUE(can_be_triangulated({star(61, 30)}, up)) << "61 * 29 crossings";
  EXPECT_FALSE(can_be_triangulated({star(1001, 500)}, up));
  EXPECT_FALSE(can_be_triangulated({star(100'001, 50'000)}, up)) << "and that is found at once";
  std::vector<Ring> rings{star(4, 1, 1000.0)};
  rings.resize(20'001, star(3, 1, 10.0));
  EXPECT_FALSE(can_be_triangulated(rings, up));
}

TEST(PolygonCrossings, MoreHolesThanTheTessellatorCanJoinAreNot) {
  const auto surface = [](int side) {
    std::vector<Ring> rings{star(4, 1, 1000.0)};
    for (int i = 0; i < side * side; ++i)
      rings.push_back(star(4, 1, 1.0, {4.0 * (i % side) - 280.0, 4.0 * (i / side) - 280.0, 0.0}));
    return rings;
  };
  EXPECT_TRUE(can_be_triangulated(surface(80), up));
  EXPECT_FALSE(can_be_triangulated(surface(140), up)) << "would take 40 s";
}

TEST(PolygonCrossings, WallsAreSeenFromTheirFront) {
  Ring wall = star(1001, 500);
  for (glm::dvec3& p : wall) p = {p.x, 0.0, p.y};
  EXPECT_FALSE(can_be_triangulated({wall}, {0.0, 1.0, 0.0}));
  Ring outline = star(1001, 1);
  for (glm::dvec3& p : outline) p = {0.0, p.x, p.y};
  EXPECT_TRUE(can_be_triangulated({outline}, {1.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace parvis::scene
