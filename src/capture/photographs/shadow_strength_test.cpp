#include "capture/photographs/shadow_strength.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace parvis::photographs {
namespace {

/// Colours of a surface of which `share` lies in a shadow that leaves `kept` of the light; its own colour
/// varies by `variation`.
std::vector<glm::vec3> surface(float share, glm::vec3 kept, float variation) {
  Random random(3);
  std::vector<glm::vec3> colours;
  for (int i = 0; i < 2000; ++i) {
    const float own = 0.5f * (1.0f + variation * (2.0f * random.uniform() - 1.0f));
    const glm::vec3 light = random.uniform() < share ? kept : glm::vec3(1.0f);
    colours.push_back(own * light * glm::vec3(1.0f, 0.95f, 0.85f));
  }
  return colours;
}

TEST(ShadowStrength, IsWhatIsLeftOfTheLightInShadow) {
  for (const float kept : {0.15f, 0.3f, 0.5f}) {
    const auto found = lit_and_shaded(surface(0.3f, glm::vec3(kept, kept, 1.2f * kept), 0.2f));
    ASSERT_TRUE(found) << kept;
    EXPECT_NEAR(found->kept, kept, 0.06f * kept);
    EXPECT_NEAR(found->lit, 0.5f * 0.95f, 0.03f);
  }
}

TEST(ShadowStrength, WhatIsNoShadowCountsNothing) {
  EXPECT_FALSE(lit_and_shaded(surface(0.0f, glm::vec3(0.3f), 0.2f))) << "all in the sun";
  EXPECT_FALSE(lit_and_shaded(surface(0.0f, glm::vec3(0.3f), 0.95f))) << "one class, however it varies";
  EXPECT_FALSE(lit_and_shaded(surface(0.01f, glm::vec3(0.3f), 0.1f))) << "a spot";
  EXPECT_FALSE(lit_and_shaded(surface(0.4f, glm::vec3(0.9f), 0.02f))) << "hardly darker";
  EXPECT_FALSE(lit_and_shaded(surface(0.4f, glm::vec3(0.3f, 0.2f, 0.1f), 0.1f))) << "red paint";
  EXPECT_FALSE(lit_and_shaded({}));
}

TEST(ShadowStrength, SurfacesVoteByWhatTheyShow) {
  const std::vector<std::optional<LitAndShaded>> surfaces{LitAndShaded{1.0f, 0.2f, 100.0f}, std::nullopt,
                                                          LitAndShaded{1.0f, 0.3f, 500.0f},
                                                          LitAndShaded{1.0f, 0.6f, 100.0f}};
  EXPECT_EQ(kept_in_shadows(surfaces), 0.3f);
  EXPECT_EQ(kept_in_shadows({}), kept_in_usual_shadow);
}

TEST(ShadowStrength, LuminancesFitAByte) {
  EXPECT_EQ(encoded_luminance(0.0f), 0);
  for (const float luminance : {0.002f, 0.4f, 1.0f, 30.0f})
    EXPECT_NEAR(decoded_luminance(encoded_luminance(luminance)) / luminance, 1.0f, 0.05f);
}

}  // namespace
}  // namespace parvis::photographs
