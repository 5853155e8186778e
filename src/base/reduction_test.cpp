#include "base/reduction.h"

#include <gtest/gtest.h>

namespace parvis {
namespace {

TEST(Reduction, HalfOfTheLightOfWhiteIs188OfSrgb) {
  Image8 edge(2, 2, 3, 0);
  for (int c = 0; c < 3; ++c) edge.at(0, 0)[c] = edge.at(1, 1)[c] = 255;
  const Image8 one = reduced(edge, 2);
  ASSERT_EQ(one.width, 1);
  ASSERT_EQ(one.height, 1);
  EXPECT_EQ(one.at(0, 0)[1], 188);
}

TEST(Reduction, EvenPicturesKeepEveryByte) {
  for (int value = 0; value < 256; ++value)
    EXPECT_EQ(reduced(Image8(3, 3, 1, std::uint8_t(value)), 3).at(0, 0)[0], value);
}

TEST(Reduction, AlphaIsAveragedAsItStands) {
  Image8 picture(2, 1, 4, 255);
  picture.at(0, 0)[3] = 0;
  Image8 square(2, 2, 4, 255);
  square.at(0, 0)[3] = square.at(0, 1)[3] = 0;
  EXPECT_EQ(reduced(square, 2).at(0, 0)[3], 128);
  EXPECT_EQ(reduced(picture, 1).pixels, picture.pixels);
}

TEST(Reduction, WhatIsNoWholeSquareIsLeftOut) {
  const Image8 small = reduced(Image8(7, 5, 3, 10), 2);
  EXPECT_EQ(small.width, 3);
  EXPECT_EQ(small.height, 2);
}

}  // namespace
}  // namespace parvis
