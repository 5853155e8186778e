#include "capture/photographs/one_spot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/random.h"

namespace parvis::photographs {
namespace {

constexpr double focal = 700.0;
const glm::dvec2 size(1000.0, 750.0);

glm::dmat3 heading(double degrees) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), glm::dvec3(0.05, 1.0, 0.02)));
}

/// `count` photographs around a full turn; neighbours share random directions, with half a pixel of noise,
/// and a quarter of the matches is wrong.
std::vector<SpotPair> turn(std::size_t count, double step_deg) {
  Random random(3);
  std::vector<SpotPair> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    SpotPair pair{i, (i + 1) % count, {}};
    while (pair.pixels.size() < 60) {
      const glm::dvec2 in_a = size * glm::dvec2(random.uniform(), random.uniform());
      const glm::dvec2 p = in_a - 0.5 * size;
      const glm::dvec3 world = heading(-step_deg * double(i)) * glm::dvec3(p.x, -p.y, -focal);
      const glm::dvec3 d = glm::transpose(heading(-step_deg * double(i + 1))) * world;
      if (d.z >= 0.0) continue;
      glm::dvec2 in_b = 0.5 * size + focal / -d.z * glm::dvec2(d.x, -d.y);
      if (in_b.x < 0 || in_b.y < 0 || in_b.x > size.x || in_b.y > size.y) continue;
      if (pair.pixels.size() % 4 == 0) in_b = size * glm::dvec2(random.uniform(), random.uniform());
      pair.pixels.emplace_back(in_a, in_b + glm::dvec2(random.uniform() - 0.5, random.uniform() - 0.5));
    }
    pairs.push_back(pair);
  }
  return pairs;
}

TEST(OneSpot, AFullTurnGivesRotationsAndTheFocalLength) {
  const SpotCameras cameras = cameras_of_one_spot(12, turn(12, 30.0), size);
  EXPECT_NEAR(cameras.focal_px, focal, 2.0);
  EXPECT_LT(cameras.error_px, 0.8);
  for (std::size_t i = 0; i < 12; ++i) {
    ASSERT_TRUE(cameras.is_placed[i]) << i;
    const glm::dvec3 seen = cameras.world_from_camera[i] * glm::dvec3(0, 0, -1),
                     truth = heading(-30.0 * double(i)) * glm::dvec3(0, 0, -1);
    EXPECT_LT(glm::degrees(std::acos(std::min(glm::dot(seen, truth), 1.0))), 0.15) << i;
  }
}

TEST(OneSpot, WhatHasNothingInCommonIsNotPlaced) {
  std::vector<SpotPair> pairs = turn(12, 30.0);
  pairs.resize(4);  // photographs 0 to 4 hang together
  const SpotCameras cameras = cameras_of_one_spot(12, pairs, size);
  EXPECT_TRUE(cameras.is_placed[4]);
  EXPECT_FALSE(cameras.is_placed[5]);
  for (SpotPair& pair : pairs) pair.pixels.resize(8);
  const SpotCameras none = cameras_of_one_spot(12, pairs, size);
  EXPECT_EQ(none.agreeing, 0u);
  EXPECT_FALSE(none.is_placed[0]);
}

}  // namespace
}  // namespace parvis::photographs
