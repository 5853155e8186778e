#include "graphics/render/picture_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace parvis::render {
namespace {

/// A frame of which `fixed_ms` is there whatever its size, and the rest by its pixels.
double frame_ms(const PictureScale& scale, double fixed_ms, double whole_ms) {
  const glm::ivec2 size = scale.drawn_size(1000, 500);
  return fixed_ms + (whole_ms - fixed_ms) * double(size.x) * double(size.y) / (1000.0 * 500.0);
}

TEST(PictureScaleTest, FindsTheSizeThatTakesTheBudget) {
  PictureScale scale;
  for (int frame = 0; frame < 60; ++frame) scale.frame_took(frame_ms(scale, 10.0, 40.0), 25.0);
  EXPECT_NEAR(frame_ms(scale, 10.0, 40.0), 25.0, 1.0);
}

TEST(PictureScaleTest, DrawsAllPixelsWhereTheyFitAndWithoutABudget) {
  PictureScale scale;
  for (int frame = 0; frame < 60; ++frame) scale.frame_took(40.0, 25.0);
  EXPECT_LT(scale.drawn_size(1000, 500).x, 1000);
  for (int frame = 0; frame < 60; ++frame) scale.frame_took(10.0, 25.0);
  EXPECT_EQ(scale.drawn_size(1000, 500), glm::ivec2(1000, 500));
  scale.frame_took(40.0, 25.0);
  scale.frame_took(40.0, 0.0);
  EXPECT_EQ(scale.drawn_size(1000, 500), glm::ivec2(1000, 500));
}

TEST(PictureScaleTest, IsNeverLessThanAQuarterAsWide) {
  PictureScale scale;
  for (int frame = 0; frame < 1000; ++frame) scale.frame_took(1e9, 1e-3);
  EXPECT_EQ(scale.drawn_size(1000, 500), glm::ivec2(250, 125));
  EXPECT_EQ(scale.drawn_size(1, 1), glm::ivec2(1, 1));
}

TEST(PictureScaleTest, StaysWhereTheClockSpreadsByLittle) {
  PictureScale scale;
  for (int frame = 0; frame < 60; ++frame) scale.frame_took(frame_ms(scale, 10.0, 40.0), 25.0);
  const glm::ivec2 found = scale.drawn_size(1000, 500);
  const double found_ms = frame_ms(scale, 10.0, 40.0);
  for (const double spread : {0.99, 1.01, 1.0, 0.985}) scale.frame_took(found_ms * spread, found_ms);
  EXPECT_EQ(scale.drawn_size(1000, 500), found);
}

}  // namespace
}  // namespace parvis::render
