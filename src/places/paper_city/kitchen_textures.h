// What is painted in the kitchen: tiles, stone, wood, cloth, skins of fruit.
#pragma once

#include <cstdint>

#include "places/paper_city/surface_canvas.h"

namespace parvis::city {

/// Metres that a sheet covers, square.
inline constexpr float floor_sheet_m = 1.2f, front_sheet_m = 0.6f, wood_sheet_m = 0.6f, cloth_sheet_m = 0.24f;

SurfacePictures wall_tile_pictures(std::uint32_t seed);
SurfacePictures floor_pictures(std::uint32_t seed);
SurfacePictures worktop_pictures(std::uint32_t seed);
SurfacePictures front_pictures(std::uint32_t seed);
SurfacePictures wood_pictures(std::uint32_t seed);
SurfacePictures cloth_pictures(std::uint32_t seed);
/// Of things turned on a lathe: once round, from the top down.
SurfacePictures orange_pictures(std::uint32_t seed);
SurfacePictures apple_pictures(std::uint32_t seed);
SurfacePictures banana_pictures(std::uint32_t seed);

/// Black, with an alpha that fades from the middle outward: under things that stand.
Image8 shade_picture();

}  // namespace parvis::city
