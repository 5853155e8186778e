// The modes of BC7 that are used, each a coder and a reader of its own (Khronos Data Format
// Specification 1.3, section 20): private to bc7_blocks.
#pragma once

#include <glm/glm.hpp>

#include "capture/facades/bc7_blocks.h"

namespace parvis::facades::bc7 {

/// Takes and appends bits, the lowest first, as the format counts them.
struct Bits {
  Bc7Block bytes{};
  int at = 0;

  void put(unsigned value, int count) {
    for (int i = 0; i < count; ++i, ++at)
      bytes[std::size_t(at / 8)] = std::uint8_t(bytes[std::size_t(at / 8)] | ((value >> i) & 1u) << (at % 8));
  }
  unsigned take(int count) {
    unsigned value = 0;
    for (int i = 0; i < count; ++i, ++at) value |= unsigned(bytes[std::size_t(at / 8)] >> (at % 8) & 1) << i;
    return value;
  }
};

/// A colour between two, as the format interpolates: weight 0..64 of the second.
inline glm::ivec4 between(const glm::ivec4& a, const glm::ivec4& b, int weight) {
  return ((64 - weight) * a + weight * b + 32) / 64;
}

/// A block with the sum of its squared errors over texels and channels.
struct Coded {
  Bc7Block block{};
  float error = 0.0f;
};

/// Rounds in which a line's endpoints are fitted again to the steps that its texels have chosen.
inline constexpr int refinements = 2;

/// Mode 6: one line of 16 colours with alpha.
Coded one_line(const BlockTexels& texels);
/// Texels of a block of mode 6.
BlockTexels texels_of_one_line(const Bc7Block& block);

/// Mode 1: the block divided by one of 64 patterns, and a line of 8 opaque colours for each part. Alpha is
/// not looked at.
Coded two_lines(const BlockTexels& texels);
/// Texels of a block of mode 1.
BlockTexels texels_of_two_lines(const Bc7Block& block);

}  // namespace parvis::facades::bc7
