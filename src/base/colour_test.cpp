#include "base/colour.h"

#include <gtest/gtest.h>

namespace parvis {
namespace {

TEST(Colour, EveryByteComesBack) {
  Image8 bytes(256, 1, 4);
  for (int i = 0; i < 256; ++i)
    for (int c = 0; c < 4; ++c) bytes.at(i, 0)[c] = std::uint8_t(i);
  EXPECT_EQ(srgb8_from_linear(linear_from_srgb8(bytes)).pixels, bytes.pixels);
}

TEST(Colour, EncodingAndDecodingAreInverse) {
  for (int i = 0; i <= 1000; ++i) {
    const float value = float(i) / 1000.0f;
    ASSERT_NEAR(linear_from_srgb(srgb_from_linear(value)), value, 1e-5f);
    ASSERT_NEAR(srgb_from_linear(linear_from_srgb(value)), value, 1e-5f);
  }
}

TEST(Colour, HasTheStandardsPoints) {
  EXPECT_EQ(linear_from_srgb(0.0f), 0.0f);
  EXPECT_NEAR(linear_from_srgb(1.0f), 1.0f, 1e-6f);
  EXPECT_NEAR(linear_from_srgb(0.5f), 0.21404f, 1e-5f);
  EXPECT_NEAR(linear_from_srgb(0.04f), 0.04f / 12.92f, 1e-7f);
  EXPECT_NEAR(luminance(glm::vec3(1.0f)), 1.0f, 1e-5f);
}

TEST(Colour, WhatNoByteHoldsIsClampedAndAlphaStaysLinear) {
  ImageF linear(1, 1, 4);
  linear.pixels = {-1.0f, 7.0f, 0.21586f, 0.5f};
  EXPECT_EQ(srgb8_from_linear(linear).pixels, (std::vector<std::uint8_t>{0, 255, 128, 128}));
}

}  // namespace
}  // namespace parvis
