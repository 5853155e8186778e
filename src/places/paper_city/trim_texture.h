// One sheet of strips that repeat to the right, for everything small: cornices, awnings, chimneys, dormers,
// signs; and the sheets of roofs and blank walls.
#pragma once

#include <cstdint>

#include "places/paper_city/surface_canvas.h"

namespace parvis::city {

enum class Trim : std::uint8_t {
  cornice,     ///< mouldings and dentils
  soffit,      ///< the cornice from below, with brackets
  slab,        ///< edge of a balcony, string course
  chimney,     ///< bricks
  awning_red,  ///< striped cloth
  awning_green,
  dormer,  ///< the front of a dormer, one every dormer_module_m
  metal    ///< painted iron: lamps, lead, signs
};
inline constexpr int trim_strips = 8;
inline constexpr float trim_sheet_m = 10.24f;    // the sheet's width
inline constexpr float dormer_module_m = 1.28f;  // eight on the sheet

/// Texture coordinates v of a strip: (foot, top).
glm::vec2 trim_strip(Trim trim);
SurfacePictures trim_pictures(std::uint32_t seed);

inline constexpr float roof_sheet_m = 5.12f;  // roof sheets cover this square; courses run to the right
SurfacePictures roof_tile_pictures(std::uint32_t seed);
SurfacePictures roof_zinc_pictures(std::uint32_t seed);

inline constexpr float blank_wall_sheet_m = 10.24f;
SurfacePictures blank_wall_pictures(std::uint32_t seed);

/// Bars between a foot and a hand rail, cut out by alpha; one metre high, `railing_sheet_m` wide.
inline constexpr float railing_sheet_m = 2.0f;
SurfacePictures railing_pictures();

}  // namespace parvis::city
