#include "graphics/reference/metrics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace parvis::reference {
namespace {

Image8 plain(std::uint8_t value, int width = 64, int height = 48) { return Image8(width, height, 3, value); }

Image8 noisy(const Image8& image, int amplitude) {
  Random random(3);
  Image8 result = image;
  for (std::uint8_t& value : result.pixels)
    value = std::uint8_t(std::clamp(int(value) + random.index(2 * amplitude + 1) - amplitude, 0, 255));
  return result;
}

Difference difference(const Image8& a, const Image8& b, const Image8& mask = {}) {
  const Result<Difference> result = compare(a, b, mask);
  EXPECT_TRUE(result) << to_string(result.errors());
  return result ? *result : Difference{};
}

TEST(Metrics, EqualPicturesDoNotDiffer) {
  const Image8 picture = noisy(plain(128), 60);
  const Difference same = difference(picture, picture);
  EXPECT_EQ(same.flip, 0.0);
  EXPECT_TRUE(std::isinf(same.psnr));
  EXPECT_NEAR(same.ssim, 1.0, 1e-9);
}

TEST(Metrics, BlackAndWhiteDifferWholly) {
  const Difference maximum = difference(plain(0), plain(255));
  // HyAB of black and white lies below that of green and blue, the largest: 0.9653 by the paper's formulas
  EXPECT_NEAR(maximum.flip, 0.965, 0.005);
  EXPECT_NEAR(maximum.psnr, 0.0, 1e-9);
}

TEST(Metrics, GreenAndBlueDifferMost) {
  Image8 green = plain(0), blue = plain(0);
  for (std::size_t i = 0; i < green.pixels.size(); i += 3) green.pixels[i + 1] = blue.pixels[i + 2] = 255;
  EXPECT_NEAR(difference(green, blue).flip, 1.0, 1e-3);
}

TEST(Metrics, FlipIsSymmetricAndGrowsWithNoise) {
  const Image8 picture = noisy(plain(128), 30);
  double last = 0.0;
  for (const int amplitude : {2, 8, 24, 60}) {
    const double there = difference(noisy(picture, amplitude), picture).flip;
    EXPECT_NEAR(there, difference(picture, noisy(picture, amplitude)).flip, 1e-6);
    EXPECT_GT(there, last);
    last = there;
  }
  EXPECT_LT(last, 1.0);
}

TEST(Metrics, PsnrOfAKnownError) {
  EXPECT_NEAR(difference(plain(100), plain(110)).psnr, 20.0 * std::log10(255.0 / 10.0), 1e-9);
}

TEST(Metrics, OnlyMaskedPixelsCount) {
  const Image8 left = plain(100);
  Image8 right = left, mask(left.width, left.height, 1, 0);
  for (int y = 0; y < left.height; ++y)
    for (int x = 40; x < left.width; ++x)
      for (int c = 0; c < 3; ++c) right.at(x, y)[c] = 200;
  for (int y = 0; y < left.height; ++y)
    for (int x = 0; x < 8; ++x) *mask.at(x, y) = 255;  // farther from the change than any filter reaches
  EXPECT_NEAR(difference(left, right, mask).flip, 0.0, 1e-4);
  EXPECT_TRUE(std::isinf(difference(left, right, mask).psnr));
}

TEST(Metrics, PicturesThatCannotBeComparedAreErrors) {
  EXPECT_FALSE(compare(plain(0, 8, 8), plain(0, 9, 8)));
  EXPECT_FALSE(compare(plain(0, 8, 8), plain(0, 8, 8), Image8(7, 8, 1, 255)));
  EXPECT_FALSE(compare(plain(0, 8, 8), plain(0, 8, 8), Image8(8, 8, 1, 0)));
}

TEST(Metrics, HeatRunsFromBlackToLight) {
  ImageF map(2, 1, 1);
  map.pixels = {0.0f, 1.0f};
  const Image8 heat = heat_map(map);
  EXPECT_LT(heat.at(0, 0)[0] + heat.at(0, 0)[1], 10);
  EXPECT_GT(heat.at(1, 0)[0] + heat.at(1, 0)[1], 480);
}

}  // namespace
}  // namespace parvis::reference
