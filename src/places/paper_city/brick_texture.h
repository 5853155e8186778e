// Brick walls with windows, for the buildings of city models that come without any.
#pragma once

#include <array>
#include <cstdint>

#include "places/paper_city/surface_canvas.h"

namespace parvis::city {

inline constexpr int brick_bays = 4, brick_storeys = 4;  // on one sheet
inline constexpr float brick_bay_m = 2.9f, brick_storey_m = 3.1f;
inline constexpr int brick_colour_count = 5;

/// Walls that differ in their bricks alone: the relief and the gloss of one are those of all.
struct BrickWalls {
  std::array<Image8, brick_colour_count> colours;  ///< sRGB
  Image8 normal, surface;
};

/// With a window in each bay, every one a little different, or plain.
BrickWalls brick_wall_pictures(bool has_windows, std::uint32_t seed);

}  // namespace parvis::city
