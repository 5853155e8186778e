// Textures of small parts: one sheet of horizontal strips (cornices, awnings, chimneys, dormers, signs); and
// sheets of roofs and blank walls.
#pragma once

#include <cstdint>

#include "synthesis/surface_canvas.h"

namespace parvis::synthesis {

/// Strips of the trim sheet.
enum class Trim : std::uint8_t {
  cornice,     ///< mouldings and dentils
  soffit,      ///< the cornice from below, with brackets
  slab,        ///< edge of a balcony, string course
  chimney,     ///< bricks
  awning_red,  ///< striped cloth
  awning_green,
  dormer,  ///< front of a dormer, repeated every dormer_module_m
  metal    ///< painted iron: lamps, lead, signs
};
inline constexpr int trim_strips = 8;
inline constexpr float trim_sheet_m = 10.24f;    // the sheet's width
inline constexpr float dormer_module_m = 1.28f;  // eight on the sheet

/// Texture coordinates v of a strip: (bottom, top).
glm::vec2 trim_strip(Trim trim);
/// Paints the sheet of all strips; each repeats to the right.
SurfacePictures trim_pictures(std::uint32_t seed);

inline constexpr float roof_sheet_m = 5.12f;  // roof sheets cover this square; courses run to the right
inline constexpr int roof_tile_columns = 24,
                     roof_tile_rows = 16;  // of tiles on a sheet, straight above another
/// Clay tiles.
SurfacePictures roof_tile_pictures(std::uint32_t seed);
/// Zinc sheets with standing seams.
SurfacePictures roof_zinc_pictures(std::uint32_t seed);

inline constexpr float blank_wall_sheet_m = 10.24f;
/// Plaster with streaks, for side walls.
SurfacePictures blank_wall_pictures(std::uint32_t seed);

/// Width of the railing sheet, metres; it is one metre high.
inline constexpr float railing_sheet_m = 2.0f;
/// A railing: bars between a base and a hand rail, cut out by alpha.
SurfacePictures railing_pictures();

}  // namespace parvis::synthesis
