// The materials of the arcaded square: sheets of stone, plaster, glass and ground, most of them grey, to
// which the vertices of walls and grounds give their colour.
#pragma once

#include <cstdint>

#include "scene/data/model.h"

namespace parvis::square {

/// Index of a material in the square's model.
enum class Surface : std::uint8_t {
  plaster,
  ashlar,
  window,
  shutter,
  railing,
  shops,  ///< synthesis::ground_floor_strip
  cloth,  ///< the trim sheet, from both sides: awnings
  tiles,
  iron,
  paving,
  setts,  ///< small stones: bands in the paving, gutters
  asphalt,
  road,  ///< a carriageway with its markings
  zebra,
  count
};

/// Albedo of the grey sheets, which a vertex's colour multiplies.
inline constexpr float sheet_albedo = 0.76f;
/// Windows on the sheet of windows, side by side.
inline constexpr int window_variants = 8;
inline constexpr float carriageway_m = 7.0f;  ///< of all streets, from kerb to kerb

/// Paints all sheets and fills the model's tables: material i is Surface(i).
void add_square_materials(scene::Model& model, std::uint64_t seed);

}  // namespace parvis::square
