#include "capture/facades/bc7_blocks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "graphics/gl/objects.h"
#include "graphics/gl/test_context.h"

namespace parvis::facades {
namespace {

double rms(const BlockTexels& a, const BlockTexels& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(double(a[i]) - double(b[i]), 2);
  return std::sqrt(sum / double(a.size()));
}

TEST(Bc7Blocks, OneColourAndALineOfColoursAreKept) {
  for (const int grey : {0, 1, 77, 128, 254, 255}) {
    BlockTexels texels;
    for (std::size_t i = 0; i < 16; ++i)
      texels[4 * i] = texels[4 * i + 1] = texels[4 * i + 2] = std::uint8_t(grey), texels[4 * i + 3] = 255;
    EXPECT_LE(rms(texels_of(bc7_block(texels)), texels), 0.51) << grey;
  }
  BlockTexels line;
  for (std::size_t i = 0; i < 16; ++i)
    line[4 * i] = std::uint8_t(15 * i), line[4 * i + 1] = std::uint8_t(240 - 15 * i), line[4 * i + 2] = 90,
             line[4 * i + 3] = std::uint8_t(10 + 15 * i);
  EXPECT_LT(rms(texels_of(bc7_block(line)), line), 2.5);
}

/// Two ramps of colour beside each other, which no one line holds.
BlockTexels two_ramps() {
  BlockTexels texels;
  for (std::size_t i = 0; i < 16; ++i) {
    const std::uint8_t value = std::uint8_t(40 + 50 * (i / 4));
    texels[4 * i] = i % 4 < 2 ? value : 30;
    texels[4 * i + 1] = i % 4 < 2 ? 30 : value;
    texels[4 * i + 2] = 60, texels[4 * i + 3] = 255;
  }
  return texels;
}

TEST(Bc7Blocks, TwoLinesOfColoursAreKeptWhereNothingIsTransparent) {
  BlockTexels texels = two_ramps();
  EXPECT_LT(rms(texels_of(bc7_block(texels)), texels), 3.0);
  texels[3] = 254;
  EXPECT_GT(rms(texels_of(bc7_block(texels)), texels), 15.0) << "the control: with alpha it is one line";
}

TEST(Bc7Blocks, NoiseIsKeptAsFarAsALineGoes) {
  Random random(7);
  BlockTexels noise;
  for (std::uint8_t& value : noise) value = std::uint8_t(255.0f * random.uniform());
  const double error = rms(texels_of(bc7_block(noise)), noise);
  EXPECT_LT(error, 75.0);
  EXPECT_GT(error, 20.0) << "16 colours of noise do not lie on a line";
  for (std::size_t i = 3; i < noise.size(); i += 4) noise[i] = 255;
  EXPECT_LT(rms(texels_of(bc7_block(noise)), noise), 45.0);
}

TEST(Bc7Blocks, OtherModesAreTransparent) {
  EXPECT_EQ(texels_of(Bc7Block{}), BlockTexels{});
  Bc7Block mode_0{};
  mode_0.fill(0xff);
  EXPECT_EQ(texels_of(mode_0), BlockTexels{});
}

class Bc7OnHardware : public gl::ContextTest {};

TEST_F(Bc7OnHardware, BlocksAreReadAsHere) {
  Random random(3);
  constexpr int side = 64;
  Image8 picture(side, side, 4);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int c = 0; c < 4; ++c) {
        const bool is_opaque = x < side / 2;
        const int value = (7 * x + 11 * y + 60 * ((x / 3 + y / 5 + c) % 3)) % 256;
        picture.at(x, y)[c] = c == 3 && is_opaque ? 255 : std::uint8_t(value + random.index(20) % 20);
      }
  const std::vector<Bc7Block> blocks = bc7_blocks(picture);
  gl::Texture texture = gl::Texture::create(GLenum(GL_TEXTURE_2D));
  glTextureStorage2D(texture.name(), 1, GL_COMPRESSED_RGBA_BPTC_UNORM, side, side);
  glCompressedTextureSubImage2D(texture.name(), 0, 0, 0, side, side, GL_COMPRESSED_RGBA_BPTC_UNORM,
                                GLsizei(blocks.size() * bc7_block_bytes), blocks.data());
  Image8 read(side, side, 4);
  glGetTextureImage(texture.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(read.pixels.size()),
                    read.pixels.data());
  EXPECT_EQ(read.pixels, picture_of(blocks.data(), side, side).pixels);
  std::size_t of_two_lines = 0;
  for (const Bc7Block& block : blocks) of_two_lines += (block[0] & 3) == 2;
  EXPECT_GT(of_two_lines, 20u) << "else only one mode was compared";
  EXPECT_LT(of_two_lines, blocks.size());
}

}  // namespace
}  // namespace parvis::facades
