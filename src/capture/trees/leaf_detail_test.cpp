// Detail that is finer than the photographs: of what it is made, and that it changes nothing in the mean.
#include "capture/trees/leaf_detail.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "capture/trees/billboard_textures.h"
#include "capture/trees/test_volume.h"

namespace parvis::trees {
namespace {

/// A ball of cells, bright and dark at random with this contrast.
BillboardTree speckled_ball(float contrast) {
  const TestVolume ball(27, 0.6f, 60.0f);
  TreeVolume volume{ball.grid, ball.extinction_per_m, {}};
  Random random(3);
  for (std::size_t i = 0; i < volume.grid.size(); ++i) {
    const float bright = 1.0f + contrast * random.uniform(-1.0f, 1.0f);
    volume.colour.push_back(bright * glm::vec3(0.3f, 0.4f, 0.2f));
  }
  std::vector<TreeView> views = ball.ring(6, 128);
  for (TreeView& view : views) view.picture = photograph_of(render_volume(volume, view.camera));
  TextureOptions options;
  options.parent_levels = 0;
  return textured(volume, views, options);
}

const BillboardTree& sample() {
  static const BillboardTree tree = speckled_ball(0.5f);
  return tree;
}

TEST(LeafDetail, HasNoMeanAndTheContrastOfTheTextures) {
  const LeafDetail detail = leaf_detail(sample());
  ASSERT_EQ(detail.texels.size(), std::size_t(LeafDetail::side * LeafDetail::side));
  glm::dvec2 sum(0.0), squares(0.0);
  double product = 0.0;
  for (const glm::i8vec2 texel : detail.texels) {
    const glm::dvec2 value = glm::dvec2(texel) / 127.0;
    sum += value, squares += value * value, product += value.x * value.y;
  }
  const double count = double(detail.texels.size());
  EXPECT_LT(std::abs(sum.x), 1e-3 * count);
  EXPECT_LT(std::abs(sum.y), 1e-3 * count);
  EXPECT_LT(std::abs(product), 0.01 * count) << "they are uncorrelated";
  EXPECT_NEAR(std::sqrt(squares.x / count), 1.0 / std::sqrt(3.0), 0.01) << "spread evenly";
  const double contrast = std::sqrt(squares.y / count);
  EXPECT_GT(contrast, 0.03);

  const LeafDetail of_even_leaves = leaf_detail(speckled_ball(0.1f));
  double even = 0.0;
  for (const glm::i8vec2 texel : of_even_leaves.texels)
    even += double(texel.y) * double(texel.y) / (127.0 * 127.0);
  EXPECT_LT(std::sqrt(even / count), 0.7 * contrast) << "leaves that are alike stay so";
  // The photographs' pixels: 4 m away, a field of view of .3 over 128 pixels.
  EXPECT_NEAR(detail.photographed_pixel_m, 4.0 * 2.0 * std::tan(0.15) / 128.0, 0.0005);
}

TEST(LeafDetail, IsAPatternOfLeavesAndNoNoise) {
  const LeafDetail detail = leaf_detail(sample());
  const auto correlation = [&](int step) {
    double sum = 0.0, squares = 0.0;
    for (int y = 0; y < LeafDetail::side; ++y)
      for (int x = 0; x < LeafDetail::side; ++x) {
        const double value = detail.texels[std::size_t(y * LeafDetail::side + x)].x;
        sum += value * detail.texels[std::size_t(y * LeafDetail::side + (x + step) % LeafDetail::side)].x;
        squares += value * value;
      }
    return sum / squares;
  };
  // Cells are 4 pixels wide in the photographs.
  EXPECT_GT(correlation(1), 0.5);
  EXPECT_LT(correlation(10), 0.3);
}

TEST(LeafDetail, IsOfItsSeed) {
  EXPECT_EQ(leaf_detail(sample(), 1).texels, leaf_detail(sample(), 1).texels);
  EXPECT_NE(leaf_detail(sample(), 1).texels, leaf_detail(sample(), 2).texels);
  EXPECT_NE(LeafDetail::offset_of(0), LeafDetail::offset_of(1));
}

TEST(LeafDetail, KeepsTheMeanOpacityAndColour) {
  const LeafDetail detail = leaf_detail(sample());
  for (const float alpha : {0.0f, 0.2f, 0.5f, 0.9f, 1.0f}) {
    const glm::vec4 colour = alpha * glm::vec4(0.2f, 0.4f, 0.1f, 1.0f);
    glm::dvec4 sum(0.0);
    double squares = 0.0;
    constexpr int steps = 256;  // four within each texel of the tile
    for (int y = 0; y < steps; ++y)
      for (int x = 0; x < steps; ++x) {
        const glm::vec4 seen =
            detail.added_to(colour, glm::vec2(float(x) + 0.5f, float(y) + 0.5f) / float(steps), 0.0f);
        ASSERT_GE(seen.w, -1e-6f);
        ASSERT_LE(seen.w, 1.0f + 1e-6f);
        sum += glm::dvec4(seen), squares += double((seen.w - alpha) * (seen.w - alpha));
      }
    sum /= double(steps) * steps, squares /= double(steps) * steps;
    EXPECT_NEAR(sum.w, alpha, 0.01);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], colour[c], 0.03 * double(colour[c]) + 1e-9) << alpha;
    if (alpha == 0.5f) {
      EXPECT_GT(std::sqrt(squares), 0.2) << "leaves and gaps";
    }
  }
}

TEST(LeafDetail, IsOnlyCloserThanThePhotographs) {
  const LeafDetail detail = leaf_detail(sample());
  const glm::vec4 colour(0.1f, 0.2f, 0.05f, 0.5f);
  const auto difference = [&](float pixel_m) {
    float sum = 0.0f;
    for (int i = 0; i < 500; ++i)
      sum +=
          std::abs(detail.added_to(colour, {0.37f * float(i), 0.21f * float(i)}, pixel_m).w - 0.5f) / 500.0f;
    return sum;
  };
  EXPECT_EQ(difference(1.0f * detail.photographed_pixel_m), 0.0f);
  EXPECT_GT(difference(0.5f * detail.photographed_pixel_m), 0.0f);
  EXPECT_GT(difference(0.2f * detail.photographed_pixel_m), difference(0.5f * detail.photographed_pixel_m));
}

TEST(LeafDetail, WithoutPatternThereIsNone) {
  BillboardTree bare;
  EXPECT_TRUE(leaf_detail(bare).is_empty());
  BillboardTree empty = sample();
  for (glm::u8vec4& base : empty.base) base.w = 0;
  for (BillboardTextures& view : empty.views)
    for (std::size_t i = 3; i < view.texels.size(); i += 4) view.texels[i] = 0;
  EXPECT_TRUE(leaf_detail(empty).is_empty());
}

}  // namespace
}  // namespace parvis::trees
