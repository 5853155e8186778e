#include "formats/city_models/osm_points.h"

#include <gtest/gtest.h>

#include <set>

namespace parvis::scene {
namespace {

std::multiset<int> found_in(const OsmPoints<int>& points, glm::dvec2 low, glm::dvec2 high) {
  std::multiset<int> found;
  points.each_in(low, high, [&](glm::dvec2, int owner) { found.insert(owner); });
  return found;
}

TEST(OsmPoints, ThoseInABoxAreFoundOnce) {
  OsmPoints<int> points;
  for (int i = 0; i < 100; ++i) points.add({-500.0 + 10.0 * i, 99.0 + 0.02 * i}, i);
  EXPECT_EQ(found_in(points, {-5.0, 0.0}, {25.0, 200.0}), (std::multiset<int>{50, 51, 52}));
  EXPECT_EQ(found_in(points, {-5.0, 100.01}, {25.0, 200.0}), (std::multiset<int>{51, 52}));
  EXPECT_TRUE(found_in(points, {0.0, 200.0}, {500.0, 900.0}).empty());
}

TEST(OsmPoints, CrowdsAndBoxesLargerThanBuildingsCostNoMoreThanOthers) {
  OsmPoints<int> points;
  for (int i = 0; i < 5000; ++i) points.add({1.0, 1.0}, i);
  EXPECT_EQ(found_in(points, {0.0, 0.0}, {2.0, 2.0}).size(), 1000u);
  EXPECT_TRUE(found_in(points, {-1e5, -1e5}, {1e5, 1e5}).empty());
}

}  // namespace
}  // namespace parvis::scene
