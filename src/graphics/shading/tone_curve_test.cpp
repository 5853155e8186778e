#include "graphics/shading/tone_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/colour.h"
#include "graphics/shading/recorded_light.h"

namespace parvis::shading {
namespace {
float mapped(float exposed) { return tone_mapped(vec3(exposed)).x; }

TEST(ToneCurve, RisesFromBlackToWhite) {
  EXPECT_NEAR(mapped(0.0f), 0.0f, 1e-6f);
  EXPECT_NEAR(mapped(8.0f), 1.0f, 1e-6f);
  float before = mapped(0.0f);
  for (int i = 1; i <= 800; ++i) {
    const float value = mapped(0.01f * float(i));
    ASSERT_GT(value, before) << "at " << 0.01f * float(i);
    before = value;
  }
}

/// Hable's curve with A 0.22, B 0.3, C 0.1, D 0.2, E 0.01, F 0.3, computed apart.
TEST(ToneCurve, HasHablesPoints) {
  const auto hables = [](double x) {
    return (x * (0.22 * x + 0.1 * 0.3) + 0.2 * 0.01) / (x * (0.22 * x + 0.3) + 0.2 * 0.3) - 0.01 / 0.3;
  };
  for (const double x : {0.05, 0.18, 0.5, 1.0, 2.0, 5.0})
    EXPECT_NEAR(double(mapped(float(x))), hables(x) / hables(8.0), 1e-5) << "at " << x;
}

TEST(ToneCurve, WhatPhotographsRecordedIsDisplayedAsItWas) {
  for (int i = 0; i <= 510; ++i) {
    const float srgb = float(i) / 510.0f;
    const auto steps_off = [&](float exposed) {
      return 255.0f * std::abs(srgb_from_linear(vec3(mapped(exposed))).x - srgb);
    };
    EXPECT_LT(steps_off(tone_unmapped(linear_from_srgb(vec3(srgb))).x), 0.1f) << i;
    EXPECT_LT(steps_off(srgb_tone_unmapped(vec3(srgb)).x), 0.1f) << i;
  }
}

TEST(ToneCurve, WhatNoDisplayCanShowIsClamped) {
  EXPECT_EQ(mapped(1000.0f), 1.0f);
  EXPECT_NEAR(mapped(-1.0f), 0.0f, 1e-6f);
}

TEST(ToneCurve, PicturesAreExposedMappedAndEncoded) {
  ImageF radiance(2, 1, 4, 0.0f);
  for (int c = 0; c < 3; ++c) radiance.at(1, 0)[c] = 4.0f;
  const Image8 picture = tone_mapped_picture(radiance, 2.0f);
  EXPECT_EQ(picture.channels, 3);
  EXPECT_EQ(picture.at(0, 0)[0], 0);
  EXPECT_EQ(picture.at(1, 0)[0], 255);
}

TEST(SampleWeight, FallsWithBrightness) {
  EXPECT_EQ(sample_weight(vec3(0.0f)), 1.0f);
  EXPECT_NEAR(sample_weight(vec3(1.0f)), 0.5f, 1e-5f);
}

}  // namespace
}  // namespace parvis::shading
