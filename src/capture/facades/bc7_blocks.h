// Block compression of RGBA textures as BC7 (BPTC: Khronos Data Format Specification 1.3, section 20): mode
// 6, a line of 16 colours with alpha, and mode 1, the block in two parts with a line of 8 opaque colours
// each, whichever is nearer. Photographs lose little by leaving out the other modes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/image.h"

namespace parvis::facades {

inline constexpr std::size_t bc7_block_bytes = 16;
using Bc7Block = std::array<std::uint8_t, bc7_block_bytes>;
using BlockTexels = std::array<std::uint8_t, 64>;  ///< 4x4 RGBA, row by row

/// Endpoints along the principal axis of the texels, refined by least squares. Blocks with alpha are of one
/// line.
Bc7Block bc7_block(const BlockTexels& texels);
/// Blocks of other modes, which `bc7_block` never makes, are transparent black.
BlockTexels texels_of(const Bc7Block& block);

/// Blocks of an RGBA picture with sides that are multiples of 4: blocks row by row.
std::vector<Bc7Block> bc7_blocks(const Image8& rgba);
/// The picture of `width` x `height` pixels, multiples of 4, that these blocks hold.
Image8 picture_of(const Bc7Block* blocks, int width, int height);

}  // namespace parvis::facades
