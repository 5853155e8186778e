// Textures of trees: sprays of leaves, and bark.
#pragma once

#include <cstdint>

#include "synthesis/surface_canvas.h"

namespace parvis::synthesis {

/// A twig with its leaves, cut out by alpha. The twig grows from the middle of the bottom edge.
SurfacePictures leaf_pictures(glm::vec3 colour, std::uint32_t seed);

/// Width of the bark sheet around the trunk, metres; it is twice as high.
inline constexpr float bark_sheet_m = 1.0f;
/// Bark of one colour; the sheet tiles.
SurfacePictures bark_pictures(glm::vec3 colour, std::uint32_t seed);

}  // namespace parvis::synthesis
