#include "planning/design/placed_object.h"

#include <gtest/gtest.h>

namespace parvis::design {
namespace {

TEST(PlacedObject, ARectangleLooksWhereItsHeadingSays) {
  const std::vector<glm::dvec2> north = rectangle_outline({10, 20}, {2, 1}, 0);
  EXPECT_NEAR(glm::distance(north[0], glm::dvec2(9, 20.5)), 0.0, 1e-12) << "its left front corner";
  EXPECT_NEAR(glm::distance(north[3], glm::dvec2(11, 20.5)), 0.0, 1e-12);
  const std::vector<glm::dvec2> east = rectangle_outline({10, 20}, {2, 1}, 90);
  EXPECT_NEAR(glm::distance(east[0], glm::dvec2(10.5, 21)), 0.0, 1e-12);
  EXPECT_NEAR(signed_area_m2(north), 2.0, 1e-12);
  EXPECT_NEAR(signed_area_m2(east), 2.0, 1e-12);
}

TEST(PlacedObject, AnEllipseFillsItsRectangle) {
  const std::vector<glm::dvec2> round = ellipse_outline({1, 2}, {4, 2}, 90, 64);
  EXPECT_NEAR(signed_area_m2(round), glm::radians(180.0) * 2.0, 0.02);
  double width = 0.0;
  for (const glm::dvec2 corner : round) width = std::max(width, std::abs(corner.y - 2.0));
  EXPECT_NEAR(width, 2.0, 1e-12) << "4 m wide along its front, which looks to the east";
}

}  // namespace
}  // namespace parvis::design
