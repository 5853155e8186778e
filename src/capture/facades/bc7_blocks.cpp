#include "capture/facades/bc7_blocks.h"

#include <algorithm>

#include "capture/facades/bc7_modes.h"

namespace parvis::facades {
namespace {

/// Squared error of a block, over 48 values, that no eye finds: two lines are not tried.
constexpr float invisible_error = 12.0f;

bool is_opaque(const BlockTexels& texels) {
  for (std::size_t i = 3; i < texels.size(); i += 4)
    if (texels[i] != 255) return false;
  return true;
}

BlockTexels block_at(const Image8& rgba, int x, int y) {
  BlockTexels texels;
  for (int row = 0; row < 4; ++row)
    std::copy_n(rgba.at(x, y + row), 16, texels.begin() + std::ptrdiff_t(16 * row));
  return texels;
}

}  // namespace

Bc7Block bc7_block(const BlockTexels& texels) {
  const bc7::Coded one = bc7::one_line(texels);
  if (one.error <= invisible_error || !is_opaque(texels)) return one.block;
  const bc7::Coded two = bc7::two_lines(texels);
  return two.error < one.error ? two.block : one.block;
}

// The number of a mode is that of the zeros before its first one.
BlockTexels texels_of(const Bc7Block& block) {
  if ((block[0] & 0x7f) == 0x40) return bc7::texels_of_one_line(block);
  if ((block[0] & 0x03) == 0x02) return bc7::texels_of_two_lines(block);
  return {};
}

std::vector<Bc7Block> bc7_blocks(const Image8& rgba) {
  std::vector<Bc7Block> blocks;
  blocks.reserve(std::size_t(rgba.width / 4) * std::size_t(rgba.height / 4));
  for (int y = 0; y < rgba.height; y += 4)
    for (int x = 0; x < rgba.width; x += 4) blocks.push_back(bc7_block(block_at(rgba, x, y)));
  return blocks;
}

Image8 picture_of(const Bc7Block* blocks, int width, int height) {
  Image8 rgba(width, height, 4);
  for (int y = 0; y < height; y += 4)
    for (int x = 0; x < width; x += 4) {
      const BlockTexels texels = texels_of(*blocks++);
      for (int row = 0; row < 4; ++row)
        std::copy_n(texels.begin() + std::ptrdiff_t(16 * row), 16, rgba.at(x, y + row));
    }
  return rgba;
}

}  // namespace parvis::facades
