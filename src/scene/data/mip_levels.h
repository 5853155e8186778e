// Mipmaps of a model's pictures: one builder for the renderer's textures and the ray tracer's.
#pragma once

#include <array>
#include <vector>

#include "scene/data/model.h"

namespace parvis::scene {

/// What each byte of a picture stands for, 0 to 1 in linear light.
using ByteTable = std::array<float, 256>;
const ByteTable& values_of_bytes(bool is_srgb);

/// For each texture of a model: is it the colour of a material that is cut out by its alpha?
std::vector<char> cutout_textures(const Model& model);

/// The picture and its halves down to one texel, averaged over 2 x 2 texels in linear light. Where alpha cuts
/// out, that of each level is scaled so that the share of texels at 0.5 and above stays the picture's own
/// (Castano 2010, Computing Alpha Mipmaps): leaves neither thin out nor swell far away.
std::vector<Image8> mip_levels(const Texture& texture, bool is_cutout);

}  // namespace parvis::scene
