// Block compression of billboard textures in the layout of BC3 (S3TC DXT5: Khronos Data Format
// Specification, 18.3 and 18.2): 16 bytes per 4x4 texels, which graphics hardware reads as they are.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace parvis::trees {

inline constexpr std::size_t block_bytes = 16;
using TextureBlock = std::array<std::uint8_t, block_bytes>;
using BlockTexels = std::array<std::uint8_t, 64>;  ///< 4x4 RGBA, row by row

/// Colours count by their alpha: those of transparent texels do not matter.
TextureBlock compressed_block(const BlockTexels& texels);
/// Any 16 bytes are a block.
BlockTexels decompressed_block(const TextureBlock& block);

}  // namespace parvis::trees
