// Brick walls with windows, for the buildings of city models that come without any.
#pragma once

#include <array>
#include <cstdint>

#include "synthesis/surface_canvas.h"

namespace parvis::dressing {

inline constexpr int brick_bays = 4, brick_storeys = 4;  // on one sheet
inline constexpr float brick_bay_m = 2.9f, brick_storey_m = 3.1f;
inline constexpr int brick_colour_count = 5;

/// Walls that differ in their bricks alone: the relief and the gloss of one are those of all.
struct BrickWalls {
  std::array<Image8, brick_colour_count> colours;  ///< sRGB
  Image8 normal, surface;
};

/// The content of a sheet.
enum class BrickSheet : std::uint8_t {
  storeys,  ///< a window in each bay, every one a little different
  street,   ///< the bands of street_level_texture.h
  plain     ///< no openings; half as wide and high as the others
};

/// Width and height of a sheet.
glm::vec2 brick_sheet_m(BrickSheet sheet);

/// The pictures of a sheet.
BrickWalls brick_wall_pictures(BrickSheet sheet, std::uint32_t seed);

/// Mean colours of bricks, linear: red, orange, brown, yellow, whitened.
std::array<glm::vec3, brick_colour_count> brick_colours();

/// Bricks all over a canvas, in the colour of `painted_brick`. Alpha is the fraction of a texel that is not
/// brick.
void paint_bricks(synthesis::SurfaceCanvas& canvas, std::uint32_t seed);
/// The colour that `paint_bricks` paints them in, linear.
glm::vec3 painted_brick();

/// The painted picture with `factor` times its colour where its alpha is 0, unchanged where it is 1; opaque.
Image8 in_colour(const Image8& painted, glm::vec3 factor);

/// Bricks on end over an opening whose top is at `top_m`, `half_m` to both sides of its middle `x_m`.
void paint_brick_lintel(synthesis::SurfaceCanvas& canvas, float x_m, float top_m, float half_m);

}  // namespace parvis::dressing
