#include "scene/action/keyframes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace parvis::action {
namespace {

const std::vector<Keyframe> keys{{0.0, {0, 0, 0}, 0.0f, 0.0f, 1.0f},
                                 {1.0, {1, 0, 0}, 3.0f, 0.5f, 2.0f},
                                 {4.0, {4, 6, 0}, -3.0f, 0.0f, 2.0f},
                                 {5.0, {4, 6, 2}, -3.0f, 0.0f, 1.0f}};

TEST(Keyframes, TheMotionPassesThroughEveryKey) {
  for (const bool is_smooth : {false, true})
    for (const Keyframe& key : keys) {
      const Keyframe at = between(keys, key.time_s, is_smooth);
      EXPECT_LT(glm::distance(at.position, key.position), 1e-5f);
      EXPECT_NEAR(std::remainder(at.heading - key.heading, 2.0f * 3.14159265f), 0.0f, 1e-5f);
      EXPECT_NEAR(at.field_of_view, key.field_of_view, 1e-5f);
    }
}

TEST(Keyframes, ItRestsBeforeAndAfter) {
  EXPECT_EQ(between(keys, -1.0, true).position, keys.front().position);
  EXPECT_EQ(between(keys, 9.0, true).position, keys.back().position);
  EXPECT_EQ(between({keys[1]}, 0.0, true).position, keys[1].position);
}

TEST(Keyframes, EvenMotionStaysEven) {
  std::vector<Keyframe> even;
  for (const double t : {0.0, 1.0, 1.5, 4.0}) even.push_back({t, {2.0f * float(t), -float(t), 1.0f}});
  for (double t = 0.0; t <= 4.0; t += 0.1)
    EXPECT_LT(glm::distance(between(even, t, true).position, glm::vec3(2 * t, -t, 1)), 1e-4f) << t;
}

TEST(Keyframes, SmoothMotionHasNoCorners) {
  const auto velocity = [&](double t) {
    return (between(keys, t + 1e-3, true).position - between(keys, t - 1e-3, true).position) / 2e-3f;
  };
  for (const double t : {1.0, 4.0})
    EXPECT_LT(glm::distance(velocity(t - 2e-3), velocity(t + 2e-3)), 0.1f) << t;
}

TEST(Keyframes, AnglesTurnTheShorterWay) {
  const Keyframe at = between(keys, 2.5, true);  // from 3 to -3: through pi, 0.28 radians
  EXPECT_NEAR(std::abs(std::remainder(at.heading, 2.0f * 3.14159265f)), 3.14159265f, 1e-4f);
}

TEST(Keyframes, TheDirectionIsThatOfTravelAndStaysAtRest) {
  EXPECT_LT(glm::distance(direction_at(keys, 4.5, false), glm::vec3(0, 0, 1)), 1e-3f);
  EXPECT_LT(glm::distance(direction_at(keys, 99.0, false), glm::vec3(0, 0, 1)), 1e-3f);
  EXPECT_EQ(direction_at({keys[0]}, 0.0, false), glm::vec3(0.0f));
  EXPECT_EQ(direction_at({{0.0, {1, 1, 1}}, {1.0, {1, 1, 1}}}, 0.5, true), glm::vec3(0.0f));
}

}  // namespace
}  // namespace parvis::action
