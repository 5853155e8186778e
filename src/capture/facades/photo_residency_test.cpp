#include "capture/facades/photo_residency.h"

#include <gtest/gtest.h>

namespace parvis::facades {
namespace {

/// Ten photographs in a row, 1 m apart, of 3 units each.
PhotoResidency row(std::size_t max_units) {
  std::vector<glm::vec3> centres;
  for (int i = 0; i < 10; ++i) centres.emplace_back(float(i), 0.0f, 0.0f);
  return PhotoResidency(centres, std::vector<std::size_t>(10, 3), max_units);
}

ResidencyChange step(PhotoResidency& residency, float x) {
  const glm::vec3 eye(x, 0.5f, 0.0f);
  return residency.follow({&eye, 1});
}

TEST(PhotoResidency, WithRoomForAllAllStay) {
  PhotoResidency residency = row(30);
  EXPECT_EQ(step(residency, 0.0f).entering.size(), 10u);
  EXPECT_TRUE(residency.is_complete());
  EXPECT_TRUE(step(residency, 9.0f).empty());
}

TEST(PhotoResidency, AWalkStaysWithinItsBudgetAndHasTheNearest) {
  PhotoResidency residency = row(13);  // four photographs, and a unit that none fits into
  std::size_t entered = 0;
  for (int i = 0; i <= 90; ++i) {
    const float x = 0.1f * float(i);
    entered += step(residency, x).entering.size();
    EXPECT_LE(residency.used_units(), 13u);
    std::size_t used = 0;
    for (const char is_resident : residency.resident()) used += is_resident ? 3u : 0u;
    EXPECT_EQ(used, residency.used_units());
    EXPECT_TRUE(residency.resident()[std::size_t(std::lround(x))]) << x;
  }
  EXPECT_EQ(entered, 10u) << "each enters once on a straight way";
  EXPECT_FALSE(residency.resident()[0]) << "the control: what is far behind was given up";
}

TEST(PhotoResidency, WhatFitsNowhereLeavesRoomForTheRest) {
  PhotoResidency residency({{0, 0, 0}, {5, 0, 0}}, {20, 2}, 10);
  EXPECT_TRUE(step(residency, 0.0f).entering.empty()) << "the nearest alone is too large";
  EXPECT_EQ(step(residency, 5.0f).entering.size(), 1u);
}

TEST(PhotoResidency, TwoEyesShareIt) {
  PhotoResidency residency = row(12);
  const std::vector<glm::vec3> eyes{{0.0f, 0.0f, 0.0f}, {9.0f, 0.0f, 0.0f}};
  residency.follow(eyes);
  EXPECT_TRUE(residency.resident()[0] && residency.resident()[9]);
  EXPECT_FALSE(residency.resident()[5]);
}

}  // namespace
}  // namespace parvis::facades
