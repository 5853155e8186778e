// The materials of the generated city: one table that all its parts share.
#pragma once

#include <cstdint>
#include <vector>

#include "places/paper_city/facade_texture.h"
#include "scene/data/model.h"

namespace parvis::city {

inline constexpr int wall_tints = 2;  ///< paints of each facade style

/// Index of a material in the city's model.
enum class CityMaterial : std::uint8_t {
  first_wall = 0,  ///< style * wall_tints + tint
  ground_floor = facade_style_count * wall_tints,
  trim,
  cloth,  ///< the trim sheet seen from both sides: awnings, signs
  roof_tile,
  roof_slate,
  roof_zinc,
  blank_wall,
  railing,
  road_wide,
  road_narrow,
  zebra_wide,
  zebra_narrow,
  asphalt,
  paving,
  lawn,
  gravel,
  courtyard,
  count
};

/// The wall material of a facade style (below facade_style_count) in one of its paints (below wall_tints).
CityMaterial wall_material(int style, int tint);

/// The seeds with which the sheets of facade styles and, last, that of ground floors are painted.
std::vector<std::uint32_t> wall_sheet_seeds(std::uint64_t seed);

/// Paints all textures in parallel and fills `model`'s tables: material i is CityMaterial(i).
void add_city_materials(scene::Model& model, std::uint64_t seed);

}  // namespace parvis::city
