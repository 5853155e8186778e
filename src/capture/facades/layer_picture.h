// The picture of one image layer as it is packed: what it covers, what of it is needed, what alpha says.
#pragma once

#include <cstdint>
#include <vector>

#include "capture/facades/packed_facade.h"

namespace parvis::facades {

inline constexpr int dilation_rings =
    6;  ///< pixels beyond a surface's edge that repeat it: filters and mipmaps
/// Alpha of pixels that were filled, in mixed tiles.
inline constexpr std::uint8_t unseen_alpha = 191;
/// Alpha of unknown pixels in mixed tiles: hidden parts of the backdrop, and those of layers whose proposals
/// were refused.
inline constexpr std::uint8_t unknown_alpha = 0;

/// A layer as it is stored, with what is needed of it.
struct LayerPicture {
  Image8 rgba;                   ///< of the box; alpha: seen or an artist's
  std::vector<char> is_covered;  ///< by a surface, dilated
  std::vector<char> is_needed;
  std::vector<char> is_own;  ///< by a surface: what other layers of the tile may not have
  bool has_alpha = false;
  bool holds_backdrop = false;
};

/// Index of a pixel, row by row.
inline std::size_t at(const PixelBox& box, int x, int y) {
  return std::size_t(y) * std::size_t(box.width) + std::size_t(x);
}

/// The box with its left and top edges moved out to the photograph's grid of tiles, so that layers may share
/// tiles.
PixelBox on_tile_grid(const PixelBox& box);

/// A picture per layer with a flag per pixel of its box: 1 where the layer has to be stored because this
/// photograph shows it, or because no photograph does and this one has the finest pixels of it. `items`: of
/// each photograph the item of each triangle.
std::vector<Image8> needed_pixels(const PlaceLayers& place,
                                  const std::vector<std::vector<std::uint32_t>>& items, std::size_t photo);

/// The picture of layer `l` of a photograph. `layer_of_pixel`: the layer that each pixel of the photograph
/// shows.
LayerPicture layer_picture(const PlaceLayers& place, std::size_t photo, std::size_t l, const Image8& needed,
                           const std::vector<std::uint32_t>& layer_of_pixel);

}  // namespace parvis::facades
