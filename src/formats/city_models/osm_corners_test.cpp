#include "formats/city_models/osm_corners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/city_models/test_rings.h"

namespace parvis::scene {
namespace {

using glm::dvec2;

/// The same corners, whichever comes first.
void expect_corners(const OsmRing& found, const OsmRing& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (const dvec2& corner : expected) EXPECT_NE(std::ranges::find(found, corner), found.end()) << corner.x;
  EXPECT_NEAR(area_m2(found), area_m2(expected), 1e-9);
}

OsmRing circle(double radius_m, int corners) {
  OsmRing ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    ring.push_back(radius_m * dvec2(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

TEST(OsmCorners, PointsAlongSidesAreNone) {
  expect_corners(corners_of(rectangle), rectangle);
  expect_corners(corners_of({{5, 0}, {7, 0.04}, {12, 0}, {12, 8}, {6, 8}, {0, 8}, {0, 0}}), rectangle);
  OsmRing many;
  for (std::size_t side = 0; side < 4; ++side)
    for (int i = 0; i < 5000; ++i)
      many.push_back(glm::mix(rectangle[side], rectangle[(side + 1) % 4], double(i) / 5000.0));
  const OsmRing found = corners_of(many);
  ASSERT_EQ(found.size(), 4u);
  for (const dvec2& corner : rectangle)
    EXPECT_TRUE(std::ranges::any_of(found, [&](dvec2 at) { return glm::distance(at, corner) < 0.08; }));
}

TEST(OsmCorners, RepeatedPointsAndSpikesAreNone) {
  expect_corners(corners_of({{0, 0}, {12, 0}, {12, 0}, {12, 0.01}, {12, 8}, {0, 8}, {0, 0}}), rectangle);
  expect_corners(corners_of({{0, 0}, {12, 0}, {30, 0}, {12, 0}, {12, 8}, {0, 8}}), rectangle);
  expect_corners(corners_of({{6, 0}, {6, -9}, {6, -20}, {6, -4}, {6, 0}, {12, 0}, {12, 8}, {0, 8}, {0, 0}}),
                 rectangle);
}

TEST(OsmCorners, ArcsStayRoundWithFewerCorners) {
  constexpr double radius_m = 20.0;
  const OsmRing found = corners_of(circle(radius_m, 5000));
  EXPECT_LT(found.size(), 100u);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const dvec2 middle_of_side = 0.5 * (found[i] + found[(i + 1) % found.size()]);
    EXPECT_GT(glm::length(middle_of_side), radius_m - 0.051);
  }
}

TEST(OsmCorners, SmallHousesKeepTheirCorners) {
  const OsmRing bay{{0, 0}, {12, 0}, {12, 3}, {12.3, 3}, {12.3, 5}, {12, 5}, {12, 8}, {0, 8}};
  expect_corners(corners_of(bay), bay);
}

TEST(OsmCorners, RingsWithoutAnAreaStayAsTheyAre) {
  const OsmRing line{{0, 0}, {5, 0}, {10, 0}}, dot{{1, 1}, {1, 1}, {1, 1}}, lost{{0, 0}, {NAN, 0}, {3, 3}};
  EXPECT_EQ(corners_of(line), line);
  EXPECT_EQ(corners_of(dot), dot);
  EXPECT_EQ(corners_of(lost).size(), 3u);
}

}  // namespace
}  // namespace parvis::scene
