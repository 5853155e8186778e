// Textures of the kitchen: tiles, stone, wood, cloth, skins of fruit.
#pragma once

#include <cstdint>

#include "synthesis/surface_canvas.h"

namespace parvis::kitchen {

/// Side of the square that each sheet covers, metres.
inline constexpr float floor_sheet_m = 1.2f, front_sheet_m = 0.6f, wood_sheet_m = 0.6f, cloth_sheet_m = 0.24f;

/// The tiled wall behind the worktop, as one sheet of 3.6 m x 0.6 m.
synthesis::SurfacePictures wall_tile_pictures(std::uint32_t seed);
synthesis::SurfacePictures floor_pictures(std::uint32_t seed);    ///< dark and light tiles in a checkerboard
synthesis::SurfacePictures worktop_pictures(std::uint32_t seed);  ///< terrazzo; one sheet of 3.6 m x 0.66 m
synthesis::SurfacePictures front_pictures(std::uint32_t seed);    ///< painted fronts of cupboards, brushed
synthesis::SurfacePictures wood_pictures(std::uint32_t seed);     ///< grain along x
synthesis::SurfacePictures cloth_pictures(std::uint32_t seed);    ///< white with red checks
/// Skin of an orange: u once around, v from the top down.
synthesis::SurfacePictures orange_pictures(std::uint32_t seed);
synthesis::SurfacePictures apple_pictures(std::uint32_t seed);  ///< red and yellow; layout of orange_pictures
/// Yellow with brown spots, green toward the ends.
synthesis::SurfacePictures banana_pictures(std::uint32_t seed);

/// A contact shadow: black, with alpha fading from the centre outward; for objects that stand on a surface.
Image8 shade_picture();

}  // namespace parvis::kitchen
