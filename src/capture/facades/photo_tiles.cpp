#include "capture/facades/photo_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parvis::facades {
namespace {

OpenSlot tile_of(const LayerPicture& picture, int column, int row) {
  const PixelBox box{0, 0, picture.rgba.width, picture.rgba.height};
  OpenSlot tile;
  for (int y = 0; y < tile_side; ++y)
    for (int x = 0; x < tile_side; ++x) {
      const int u = column * tile_inner + x - tile_border, v = row * tile_inner + y - tile_border;
      const int px = std::clamp(u, 0, box.width - 1), py = std::clamp(v, 0, box.height - 1);
      const std::size_t i = std::size_t(y * tile_side + x);
      if (picture.holds_backdrop &&
          (u != px || v != py)) {  // beyond the box: known as little as behind surfaces
        tile.texels.at(x, y)[3] = unknown_alpha, tile.is_covered[i] = tile.is_own[i] = 1;
        continue;
      }
      if (std::abs(u - px) > dilation_rings || std::abs(v - py) > dilation_rings) continue;
      if (!picture.is_covered[at(box, px, py)]) continue;
      std::copy_n(picture.rgba.at(px, py), 4, tile.texels.at(x, y));
      tile.is_covered[i] = 1;
      tile.is_own[i] = u == px && v == py && picture.is_own[at(box, px, py)];
    }
  return tile;
}

/// Texels far from any surface take the mean colour, which compresses best. Where all that is known was seen,
/// alpha is 255 throughout: then it costs no precision.
void complete(OpenSlot& slot) {
  std::array<long, 4> sum{};
  long count = 0;
  bool is_opaque = true;
  for (std::size_t i = 0; i < slot.is_covered.size(); ++i)
    if (slot.is_covered[i]) {
      for (std::size_t c = 0; c < 4; ++c) sum[c] += slot.texels.pixels[4 * i + c];
      is_opaque &= !slot.is_own[i] || slot.texels.pixels[4 * i + 3] == 255;
      ++count;
    }
  for (std::size_t i = 0; i < slot.is_covered.size(); ++i) {
    if (!slot.is_covered[i] && count > 0)
      for (std::size_t c = 0; c < 4; ++c) slot.texels.pixels[4 * i + c] = std::uint8_t(sum[c] / count);
    if (is_opaque) slot.texels.pixels[4 * i + 3] = 255;
  }
}

/// Whether a texel was seen is kept per block: colours then need not share a block's line with alpha, which
/// would cost them most of their precision. Blocks that hold what is not known, or an artist's alpha, stay.
void decide_blocks(Image8& texels) {
  for (int top = 0; top < texels.height; top += 4)
    for (int left = 0; left < texels.width; left += 4) {
      int minimum = 255, sum = 0;
      for (int i = 0; i < 16; ++i) {
        const int alpha = texels.at(left + i % 4, top + i / 4)[3];
        minimum = std::min(minimum, alpha), sum += alpha;
      }
      if (minimum < unseen_alpha || minimum == 255) continue;
      const std::uint8_t alpha = 2 * sum >= 16 * (255 + unseen_alpha) ? 255 : unseen_alpha;
      for (int i = 0; i < 16; ++i) texels.at(left + i % 4, top + i / 4)[3] = alpha;
    }
}

Image8 halved(const Image8& image) {
  Image8 half(image.width / 2, image.height / 2, 4);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (int c = 0; c < 4; ++c)
        half.at(x, y)[c] =
            std::uint8_t((image.at(2 * x, 2 * y)[c] + image.at(2 * x + 1, 2 * y)[c] +
                          image.at(2 * x, 2 * y + 1)[c] + image.at(2 * x + 1, 2 * y + 1)[c] + 2) /
                         4);
  return half;
}

/// Is anything of the tile needed, and what does its alpha say?
TileKind kind_of(const LayerPicture& picture, int column, int row) {
  const PixelBox box{0, 0, picture.rgba.width, picture.rgba.height};
  bool is_needed = false, is_all_seen = true;
  for (int y = row * tile_inner; y < std::min((row + 1) * tile_inner, box.height); ++y)
    for (int x = column * tile_inner; x < std::min((column + 1) * tile_inner, box.width); ++x) {
      if (!picture.is_covered[at(box, x, y)]) continue;
      is_needed |= picture.is_needed[at(box, x, y)] != 0;
      is_all_seen &= picture.rgba.at(x, y)[3] == 255;
    }
  if (!is_needed) return TileKind::none;
  return is_all_seen ? TileKind::seen : picture.has_alpha ? TileKind::alpha : TileKind::mixed;
}

}  // namespace

bool OpenSlot::take(const OpenSlot& other) {
  for (std::size_t i = 0; i < is_own.size(); ++i)
    if (is_own[i] && other.is_own[i]) return false;
  for (std::size_t i = 0; i < is_own.size(); ++i) {
    if (!other.is_covered[i] || is_own[i] || (is_covered[i] && !other.is_own[i])) continue;
    std::copy_n(other.texels.pixels.data() + 4 * i, 4, texels.pixels.data() + 4 * i);
    is_covered[i] = 1, is_own[i] = other.is_own[i];
  }
  return true;
}

std::vector<Bc7Block> blocks_of(OpenSlot& slot) {
  complete(slot);
  std::vector<Bc7Block> blocks;
  for (int level = 0; level < tile_levels; ++level) {
    if (!slot.has_artists_alpha) decide_blocks(slot.texels);
    std::ranges::copy(bc7_blocks(slot.texels), std::back_inserter(blocks));
    slot.texels = halved(slot.texels);
  }
  return blocks;
}

void PhotoTiles::add(const LayerPicture& picture, const PackedLayer& layer, std::size_t first_slot,
                     PackedFacade& facade) {
  for (int row = 0; row < layer.down(); ++row)
    for (int column = 0; column < layer.across(); ++column) {
      const TileKind kind = kind_of(picture, column, row);
      std::uint32_t entry = std::uint32_t(kind);
      if (kind != TileKind::none) {
        OpenSlot tile = tile_of(picture, column, row);
        tile.has_artists_alpha = kind == TileKind::alpha;
        tile.cell = glm::ivec2(layer.box.x / tile_inner + column, layer.box.y / tile_inner + row);
        entry |= std::uint32_t(first_slot + place(std::move(tile), kind)) << 2;
      }
      facade.tiles.push_back(entry);
    }
}

std::size_t PhotoTiles::place(OpenSlot tile, TileKind kind) {
  std::vector<std::size_t>& here = slots_of_cell_[{tile.cell.x, tile.cell.y}];
  if (kind != TileKind::alpha)
    for (const std::size_t slot : here)
      if (slots_[slot].take(tile)) return slot;
  if (kind != TileKind::alpha) here.push_back(slots_.size());
  slots_.push_back(std::move(tile));
  return slots_.size() - 1;
}

}  // namespace parvis::facades
