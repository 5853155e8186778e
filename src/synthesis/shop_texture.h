// Texture of ground floors: one sheet with strips of shop fronts, and a strip of house doors and barred
// windows.
#pragma once

#include <cstdint>

#include "base/random.h"
#include "synthesis/surface_canvas.h"

namespace parvis::synthesis {

inline constexpr float ground_floor_m = 4.5f;  // height of a strip as painted
inline constexpr float shop_module_m = 5.12f;  // width of a shop, and of a door with its windows
inline constexpr int shop_modules = 5;         // in a strip
inline constexpr int shop_strips = 3, house_strip = shop_strips, ground_floor_strips = 4;

/// Texture coordinates v of a strip: (bottom, top).
glm::vec2 ground_floor_strip(int strip);

/// Paints the display in a shop's window: rows of things on shelves, of colours mixed with `tint`, and light
/// from lamps above.
void paint_shop_display(SurfaceCanvas& canvas, const Rect& glass, glm::vec3 tint, Random& random);

/// The painted sheet of all strips.
SurfaceCanvas ground_floor_canvas(std::uint32_t seed);
/// Its textures.
SurfacePictures ground_floor_pictures(std::uint32_t seed);

}  // namespace parvis::synthesis
