// Mipmaps of a model's pictures: one builder for the renderer's textures and the ray tracer's.
#pragma once

#include <array>
#include <vector>

#include "scene/data/model.h"

namespace parvis::scene {

/// Value of each possible byte of an image, 0 to 1, linear.
using ByteTable = std::array<float, 256>;
/// The table of sRGB-encoded or of linear bytes.
const ByteTable& values_of_bytes(bool is_srgb);

/// Thresholds, one per texture of a model: where it is the colour of a cutout material, the alpha (1 to 255)
/// from which on its texels are visible; else 0.
std::vector<int> visible_alphas(const Model& model);

/// The mipmap levels of a texture below its picture, box-filtered over 2 x 2 texels in linear light. For
/// cutout textures, alpha of each level is scaled so that the fraction of texels at `visible_alpha` and above
/// is that of level 0 (Castano 2010, Computing Alpha Mipmaps): distant leaves neither thin out nor swell.
std::vector<Image8> smaller_mip_levels(const Texture& texture, int visible_alpha);

}  // namespace parvis::scene
