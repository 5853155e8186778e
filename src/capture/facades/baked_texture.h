// One texture for all surfaces of a captured place, for programs that know nothing of photographs chosen by
// the view: each point as it is seen along its normal.
#pragma once

#include <vector>

#include "base/image.h"
#include "capture/facades/packed_facade.h"

namespace parvis::facades {

struct BakedTexture {
  Image8 picture;              ///< sRGB RGBA; sides are powers of two
  std::vector<glm::vec2> uvs;  ///< three per triangle of the facade; v = 0 is the picture's top row
};

/// Each triangle becomes the half of a square with a power-of-two side, as fine as its finest photograph, and
/// all are made coarser alike until the picture has at most `max_side` pixels per side (a power of two, 64 or
/// more). Very many triangles may need more: no square is smaller than 8.
BakedTexture baked_texture(const PackedFacade& facade, int max_side);

}  // namespace parvis::facades
