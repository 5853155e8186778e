#include "graphics/light/estimate_weights.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace parvis::light {
namespace {

/// Values about 1, a guess that is off by `guess_off` of each, and two halves of rays by `half_off`.
struct Sample {
  std::vector<float> guess;
  Halves found;
};

Sample sample(float guess_off, float half_off) {
  Random random(5);
  const auto noise = [&] {  // of variance 1
    return 1.7320508f * random.uniform(-1.0f, 1.0f);
  };
  Sample all;
  for (int v = 0; v < 20'000; ++v) {
    const float value = 1.0f + noise();
    all.guess.push_back(value + guess_off * noise());
    all.found.first.push_back(value + half_off * noise());
    all.found.second.push_back(value + half_off * noise());
  }
  return all;
}

TEST(WeightOfRays, IsThatOfTheSmallestError) {
  for (const auto& [guess_off, half_off] : {std::pair(0.3f, 0.3f), {0.1f, 0.5f}, {1.0f, 0.1f}}) {
    const float guess = guess_off * guess_off, rays = 0.5f * half_off * half_off;
    const Sample all = sample(guess_off, half_off);
    EXPECT_NEAR(weight_of_rays(all.guess, all.found), guess / (guess + rays), 0.02f) << guess_off;
  }
}

TEST(WeightOfRays, IsNothingForAGuessWithoutError) {
  const Sample all = sample(0.0f, 0.5f);
  EXPECT_NEAR(weight_of_rays(all.guess, all.found), 0.0f, 0.02f);
  const std::vector<float> same{1.0f, 2.0f};
  EXPECT_EQ(weight_of_rays(same, {same, same}), 0.0f);
  EXPECT_EQ(weight_of_rays({}, {}), 0.0f);
}

TEST(WeightOfChanges, IsThatOfTheNearestMixture) {
  Random random(7);
  std::vector<glm::vec3> changes, mixture, beyond, against;
  for (int i = 0; i < 200; ++i) {
    const auto any = [&] { return random.uniform(-1.0f, 1.0f); };
    changes.emplace_back(any(), any(), any());
    mixture.push_back(0.3f * changes.back() + 0.1f * glm::vec3(any()));
    beyond.push_back(3.0f * changes.back());
    against.push_back(-changes.back());
  }
  EXPECT_NEAR(weight_of_changes(changes, mixture), 0.3f, 0.03f);
  EXPECT_EQ(weight_of_changes(changes, beyond), 1.0f);
  EXPECT_EQ(weight_of_changes(changes, against), 0.0f);
  EXPECT_EQ(weight_of_changes({}, {}), 0.0f);
}

}  // namespace
}  // namespace parvis::light
