#include "scene/data/mip_levels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/colour.h"
#include "base/random.h"

namespace parvis::scene {
namespace {

/// Thin leaves here and there: ellipses of random places and headings.
Texture leaves(float wanted_coverage) {
  Texture texture{"leaves", Image8(256, 256, 4, 0)};
  Random random(3);
  double covered = 0.0;
  while (covered < wanted_coverage) {
    const float y = random.uniform(0, 256), x = random.uniform(0, 256);
    const glm::vec2 middle(x, y);
    const float heading = random.uniform(0.0f, 3.14f);
    const glm::vec2 along(std::cos(heading), std::sin(heading));
    for (int row = 0; row < 256; ++row)
      for (int column = 0; column < 256; ++column) {
        const glm::vec2 p = glm::vec2(column, row) - middle;
        const glm::vec2 in_leaf(glm::dot(p, along) / 14.0f, (p.x * along.y - p.y * along.x) / 2.5f);
        std::uint8_t& alpha = texture.image.at(column, row)[3];
        if (glm::length(in_leaf) < 1.0f && alpha == 0) alpha = 255, covered += 1.0 / 65536.0;
      }
  }
  return texture;
}

double coverage(const Image8& image) {
  double sum = 0.0;
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) sum += image.pixels[i] >= 128;
  return sum / double(image.pixels.size() / 4);
}

TEST(MipLevels, CutOutsKeepTheirCoverage) {
  for (const float share : {0.15f, 0.4f, 0.8f}) {
    const Texture texture = leaves(share);
    const std::vector<Image8> levels = smaller_mip_levels(texture, 128);
    ASSERT_EQ(levels.size(), 8u);
    // A mask's means take five values on the first level: steps of up to a tenth. A few texels show no share
    // at all.
    for (std::size_t i = 0; levels[i].width >= 8; ++i)
      EXPECT_NEAR(coverage(levels[i]), coverage(texture.image), 0.05) << share << ", level " << i;
    EXPECT_LT(coverage(smaller_mip_levels(leaves(0.15f), 0)[3]), 0.03);  // they would vanish
  }
}

TEST(MipLevels, AverageInLinearLight) {
  Texture texture{"black and white", Image8(2, 1, 4, 255)};
  for (int c = 0; c < 3; ++c) texture.image.at(0, 0)[c] = 0;
  EXPECT_EQ(smaller_mip_levels(texture, 0)[0].at(0, 0)[0], 188);  // sRGB of a half
  texture.is_srgb = false;
  EXPECT_EQ(smaller_mip_levels(texture, 0)[0].at(0, 0)[0], 128);
}

/// Each byte of a mean of bytes is that of the formula.
TEST(MipLevels, RoundAsSrgbDoes) {
  Texture texture{"pairs", Image8(512, 512, 4, 255)};  // four bytes for each texel of the next level
  const ByteTable& light = values_of_bytes(true);
  Random random(5);
  for (std::uint8_t& value : texture.image.pixels) value = std::uint8_t(random.index(random.index(256) + 1));
  const Image8 half = smaller_mip_levels(texture, 0)[0];
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (int c = 0; c < 3; ++c) {
        float sum = light[texture.image.at(2 * x, 2 * y)[c]] + light[texture.image.at(2 * x + 1, 2 * y)[c]];
        sum = sum + light[texture.image.at(2 * x, 2 * y + 1)[c]];
        sum = sum + light[texture.image.at(2 * x + 1, 2 * y + 1)[c]];
        ASSERT_EQ(half.at(x, y)[c], std::lround(255.0f * srgb_from_linear(0.25f * sum)));
      }
}

TEST(MipLevels, OddSizesAndPlainAlphaStandAsTheyAre) {
  Texture texture{"grey", Image8(5, 3, 4, 77), false};
  for (const int visible : {0, 60, 128})
    for (const Image8& level : smaller_mip_levels(texture, visible))
      for (const std::uint8_t value : level.pixels) EXPECT_EQ(value, 77);
}

TEST(MipLevels, TexturesOfCutOutMaterialsAreKnown) {
  Model model;
  model.textures.resize(3);
  model.materials.resize(2);
  model.materials[0].base_colour_texture = 0;
  model.materials[1].base_colour_texture = 2;
  model.materials[1].alpha_mode = Alpha::cutout;
  EXPECT_EQ(visible_alphas(model), (std::vector<int>{0, 0, 128}));
  model.materials[1].alpha_cutoff = 0.2f;
  EXPECT_EQ(visible_alphas(model), (std::vector<int>{0, 0, 51}));
}

}  // namespace
}  // namespace parvis::scene
