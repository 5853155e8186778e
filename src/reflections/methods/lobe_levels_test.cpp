#include "reflections/methods/lobe_levels.h"

#include <gtest/gtest.h>

namespace parvis::methods {
namespace {

TEST(LobeLevels, ALevelHoldsTheRoughnessThatLooksItUp) {
  for (const float levels : {4.0f, 7.0f, 10.0f})
    for (float level = 1.0f; level < levels; ++level)
      EXPECT_NEAR(level_of_roughness(levels, roughness_of_level(levels, level)), level, 1e-3f);
  EXPECT_EQ(roughness_of_level(7.0f, 7.0f), 1.0f) << "no surface is rougher";
  EXPECT_LT(level_of_roughness(7.0f, 0.02f), 0.0f) << "a mirror shows the sharpest";
}

/// Mean cosine between the normal and the directions, by the distribution itself, without its directions.
double mean_cosine(double roughness) {
  constexpr int steps = 100000;
  const double alpha_squared = std::pow(roughness, 4.0);
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double u = (i + 0.5) / steps;
    sum += 2.0 * (1.0 - u) / (1.0 + (alpha_squared - 1.0) * u) - 1.0;
  }
  return sum / steps;
}

TEST(LobeLevels, DirectionsAreThoseOfTheLobeAboutAnyNormal) {
  constexpr int count = 512;
  for (const glm::vec3 normal : {glm::vec3(0, 0, 1), glm::vec3(0.6f, 0, -0.8f), glm::vec3(0, -1, 0)})
    for (const float roughness : {0.1f, 0.3f, 0.7f, 1.0f}) {
      glm::vec3 mean(0.0f);
      for (int i = 0; i < count; ++i) {
        const glm::vec4 at = lobe_sample(normal, roughness, i, count);
        ASSERT_NEAR(glm::length(glm::vec3(at)), 1.0f, 1e-3f);
        ASSERT_GT(at.w, 0.0f);
        mean += glm::vec3(at) / float(count);
      }
      EXPECT_NEAR(glm::dot(mean, normal), mean_cosine(double(roughness)), 0.01) << roughness;
      EXPECT_LT(glm::length(mean - glm::dot(mean, normal) * normal), 0.02f) << "they lie all around";
    }
}

}  // namespace
}  // namespace parvis::methods
