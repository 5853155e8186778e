// The blocks of 4x4 texels of a photograph's textures: texture by texture, row by row.
#pragma once

#include <algorithm>
#include <cstddef>

#include "capture/trees/billboard_tree.h"
#include "capture/trees/texture_blocks.h"

namespace parvis::trees {

/// Calls visit(texels, row_bytes) with a pointer to each block's first texel and how far its rows are apart.
/// `side`: texels along a texture's side, a multiple of 4. `texels`: of the textures, RGBA.
template <class Texels, class Visit>
void for_each_block_place(Texels& texels, int side, Visit&& visit) {
  const std::size_t row_bytes = 4 * std::size_t(side), texture_bytes = row_bytes * std::size_t(side);
  for (std::size_t texture = 0; texture + texture_bytes <= texels.size(); texture += texture_bytes)
    for (std::size_t row = 0; row < std::size_t(side); row += 4)
      for (std::size_t column = 0; column < std::size_t(side); column += 4)
        visit(texels.data() + texture + row * row_bytes + 4 * column, row_bytes);
}

/// Calls visit(block) for the texels of each block.
template <class Visit>
void for_each_block(const BillboardTextures& view, int side, Visit&& visit) {
  for_each_block_place(view.texels, side, [&](const std::uint8_t* place, std::size_t row_bytes) {
    BlockTexels block;
    for (std::size_t y = 0; y < 4; ++y) std::copy_n(place + y * row_bytes, 16, block.data() + 16 * y);
    visit(block);
  });
}

/// Replaces the texels of each block by those that make() returns.
template <class Make>
void replace_blocks(BillboardTextures& view, int side, Make&& make) {
  for_each_block_place(view.texels, side, [&](std::uint8_t* place, std::size_t row_bytes) {
    const BlockTexels block = make();
    for (std::size_t y = 0; y < 4; ++y) std::copy_n(block.data() + 16 * y, 16, place + y * row_bytes);
  });
}

}  // namespace parvis::trees
