// What the kitchen is made of: one table of materials and pictures for all that stands still in it.
#pragma once

#include <cstdint>

#include "scene/data/model.h"

namespace parvis::kitchen {

enum class KitchenMaterial : std::uint8_t {
  tiles,    ///< glazed, 10 cm, some with a flower
  plaster,  ///< of the walls; see `room_shell` in kitchen_materials.cpp
  ceiling,
  floor,    ///< black and white tiles
  worktop,  ///< pale stone
  front,    ///< of cupboards: sage paint
  wood,
  cloth,  ///< red squares
  frame,  ///< white paint: window, skirting
  black,  ///< iron, handles
  hob,    ///< black glass
  view,   ///< what lies before the window
  orange,
  lemon,
  apple,
  pear,
  banana,
  stalk,
  china,  ///< white
  blue,   ///< blue glaze
  clay,   ///< terracotta
  honey,  ///< what stands in jars
  shade,  ///< under things: blends
  count
};

/// The sheets that are painted for one place have its size.
inline constexpr float worktop_m[2]{3.6f, 0.66f}, tiled_m[2]{3.6f, 0.6f};

/// Paints all textures and fills `model`'s tables: material i is KitchenMaterial(i).
void add_kitchen_materials(scene::Model& model, std::uint64_t seed);

/// Adds a part, named as errors and scripts call it.
void add_part(scene::Model& model, const char* name, Mesh mesh, KitchenMaterial material);

}  // namespace parvis::kitchen
