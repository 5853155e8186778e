#include "graphics/lit_objects/guessed_light.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace parvis::lit_objects {
namespace {

using glm::vec3;

/// Vertices that have moved, with another change of the interpolated sky each.
struct Moved {
  KnownLight known;
  Clues now;

  Moved() {
    Random random(3);
    known.interpolated.emplace();
    for (int v = 0; v < 400; ++v) {
      known.traced.sky.emplace_back(random.uniform(0.5f, 2.0f));
      known.traced.sun.emplace_back(random.uniform(0.0f, 3.0f));
      known.interpolated->irradiance.emplace_back(random.uniform(1.0f, 3.0f));
      known.interpolated->open.emplace_back(3.0f);
      now.interpolated.irradiance.emplace_back(random.uniform(1.0f, 3.0f));
      now.interpolated.open.emplace_back(3.0f);
      now.sun.emplace_back(random.uniform(0.0f, 3.0f));
    }
  }

  vec3 changed(std::size_t v) const {
    return known.traced.sky[v] * now.interpolated.irradiance[v] / known.interpolated->irradiance[v];
  }

  /// Judged by rays that scatter by 0.2 about the true light.
  template <class Sky, class Sun>
  GuessWeights weights(const Sky& true_sky, const Sun& true_sun) const {
    Random random(5);
    GuessJudge judge;
    for (std::size_t v = 0; v < known.traced.sky.size(); ++v)
      judge.add(known, now, v, true_sky(v) + random.uniform(-0.35f, 0.35f),
                true_sun(v) + random.uniform(-0.35f, 0.35f));
    return judge.weights();
  }
};

TEST(GuessedLight, IsTheOldOneWhereNothingHasChanged) {
  const Moved moved;
  const GuessWeights weights = moved.weights([&](std::size_t v) { return moved.known.traced.sky[v]; },
                                             [&](std::size_t v) { return moved.known.traced.sun[v]; });
  EXPECT_LT(weights.sky, 0.05f);
  EXPECT_LT(weights.sun, 0.05f);
  const SplitLight guess = guessed_light(moved.known, moved.now, {0.0f, 0.0f});
  EXPECT_EQ(guess.sky, moved.known.traced.sky);
  EXPECT_EQ(guess.sun, moved.known.traced.sun);
}

TEST(GuessedLight, ChangesAsTheInterpolatedLightWhereThatIsSo) {
  const Moved moved;
  const GuessWeights weights = moved.weights([&](std::size_t v) { return moved.changed(v); },
                                             [&](std::size_t v) { return moved.now.sun[v]; });
  EXPECT_NEAR(weights.sky, 1.0f, 0.05f);
  EXPECT_NEAR(weights.sun, 1.0f, 0.05f);
  const SplitLight guess = guessed_light(moved.known, moved.now, {1.0f, 1.0f});
  for (std::size_t v = 0; v < guess.sky.size(); ++v) {
    EXPECT_NEAR(guess.sky[v].y, moved.changed(v).y, 1e-4f);
    EXPECT_NEAR(guess.sun[v].y, moved.now.sun[v].y, 1e-4f);
  }
}

TEST(GuessedLight, GoesPartOfTheWayWhereThatIsNearest) {
  const Moved moved;
  const auto half_way = [](vec3 a, vec3 b) { return 0.5f * (a + b); };
  const GuessWeights weights =
      moved.weights([&](std::size_t v) { return half_way(moved.known.traced.sky[v], moved.changed(v)); },
                    [&](std::size_t v) { return half_way(moved.known.traced.sun[v], moved.now.sun[v]); });
  EXPECT_NEAR(weights.sky, 0.5f, 0.05f);
  EXPECT_NEAR(weights.sun, 0.5f, 0.05f);
}

/// A vertex that places around saw in the dark has no share of what they saw that could be known: out of the
/// dark it has all that they see.
TEST(GuessedLight, IsTheInterpolatedOneWhereAllWasDark) {
  Moved moved;
  moved.known.interpolated->uncertainty = 0.1f;
  moved.known.interpolated->irradiance[0] = moved.known.traced.sky[0] = vec3(1e-4f);
  moved.now.interpolated.irradiance[0] = vec3(2.0f);
  const auto sky = [&] { return guessed_light(moved.known, moved.now, {1.0f, 1.0f}).sky[0].y; };
  EXPECT_NEAR(sky(), 2.0f, 0.01f);
  moved.known.interpolated->irradiance[0] = vec3(3.0f), moved.known.traced.sky[0] = vec3(0.3f);
  EXPECT_NEAR(sky(), 0.3f - 0.6f / 3.3f, 0.01f) << "in its own shade it has less of a change";
  moved.now.interpolated.irradiance[0] = vec3(0.0f);
  EXPECT_EQ(sky(), 0.0f) << "never less than none";
  moved.known.interpolated.reset();
  EXPECT_EQ(sky(), 0.3f) << "of what is not expected to move nothing is known";
}

}  // namespace
}  // namespace parvis::lit_objects
