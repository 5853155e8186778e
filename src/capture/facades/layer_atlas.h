// All layers of a photograph in one texture.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "base/image.h"
#include "capture/facades/layered_picture.h"

namespace parvis::facades {

/// Texels around each layer that repeat its rim, so that filters and three mipmap levels stay within the
/// layer.
inline constexpr int atlas_border = 4;

/// All layers of one photograph in one texture.
struct LayerAtlas {
  Image8 colours;  ///< RGBA, sRGB; sides are multiples of 4 (blocks of BC7)
  Image8 seen;  ///< 1 channel: 255 where the photograph sees the surface, 0 where it was filled or is empty
  std::vector<glm::ivec2> offsets;  ///< per layer: texel of its box's top left

  /// Texture memory in BC7, which takes a byte per texel for colour and alpha.
  std::size_t compressed_bytes() const { return std::size_t(colours.width) * std::size_t(colours.height); }
};

/// Packs the layers on shelves, the highest first. Pixels that no surface of a layer covers take the colour
/// of the nearest covered pixel within the border's reach.
LayerAtlas layer_atlas(const LayeredView& layered, const LayerPixels& pixels);

}  // namespace parvis::facades
