#include "base/image_text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace parvis {
namespace {

std::size_t dark_pixels(const Image8& picture) {
  std::size_t dark = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) dark += picture.at(x, y)[0] < 128 ? 1 : 0;
  return dark;
}

TEST(ImageText, ALineIsAsWideAsItSaysAndStandsOnItsBaseline) {
  const int width = text_width("12 h", 20);
  if (width == 0) GTEST_SKIP() << "skipped: the machine has neither Inter nor DejaVu Sans";
  Image8 picture(120, 60, 4, 255);
  write_text(picture, {10, 40}, "12 h", 20, {0, 0, 0});
  EXPECT_GT(dark_pixels(picture), 60u);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (picture.at(x, y)[0] < 128) {
        EXPECT_GE(x, 9);
        EXPECT_LE(x, 12 + width);
        EXPECT_LE(y, 41) << "no letter reaches below the line";
        EXPECT_GE(y, 18);
      }
}

TEST(ImageText, WhatLiesOutsideIsLeftOut) {
  Image8 picture(8, 8, 4, 255);
  write_text(picture, {-30, 4}, "metres", 12, {0, 0, 0});
  write_text(picture, {500, 900}, "metres", 12, {0, 0, 0});
  EXPECT_EQ(picture.width, 8);
}

}  // namespace
}  // namespace parvis
