// Lamps and the grid that finds those near a place: the C++ face of lamps.glsl.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "graphics/shading/octahedral.h"
#include "graphics/shading/surface.h"

namespace parvis::shading {
#include "graphics/shading/lamps.glsl"

/// Lamps that are lit, and which of them reach each cell of the ground.
struct LampTable {
  vec2 corner{0.0f};        ///< of least coordinates
  float cell_m = 1.0f;      ///< side of a cell
  glm::ivec2 cells{0};      ///< in x and y; 0: there are no lamps
  std::vector<uvec4> near;  ///< by cell, x fastest: up to eight numbers plus 1 of 16 bits, strongest first
  std::vector<Lamp> lamps;
  /// Maps of lamp_map_px squared: shares of the reach, 65535: all of it. Not owned.
  std::span<const std::uint16_t> depths;

  /// No lamp is lit.
  bool empty() const { return lamps.empty(); }
  /// The entry of `near` for a point; zero outside.
  uvec4 cell(vec3 position) const;
  /// Calls `visit(number)` for each lamp that reaches the cell of a point, the strongest first.
  template <class Visit>
  void for_each_near(vec3 position, const Visit& visit) const {
    const uvec4 numbers = cell(position);
    for (int i = 0; i < 4; ++i)
      for (std::uint32_t word = numbers[i]; word != 0; word >>= 16) visit((word & 65535u) - 1);
  }
  /// The share of a lamp that its depth map shows to a surface: four comparisons, as a texture unit mixes
  /// them; 1 where it has no map.
  float visible(const Lamp& lamp, vec3 position, vec3 geometric_normal) const;
};

/// Most lamps that one cell has; of more, the strongest shine.
inline constexpr int max_lamps_per_cell = 8;

/// Most lamps of a table: the grid has 16 bits for a number plus 1.
inline constexpr std::size_t max_lamps = 65534;

/// The table of the first `max_lamps` lamps.
LampTable make_lamp_table(std::vector<Lamp> lamps);

/// lamps_lookup.glsl over a table; `visible(lamp, position, geometric_normal)` says which share of a lamp a
/// surface sees.
template <class Visible>
struct LampLookup {
  const LampTable& table;
  const Visible& visible;

  /// The cell's entry, called by the lookup.
  uvec4 lamp_cell(vec3 position) const { return table.cell(position); }
  /// A lamp by its number, called by the lookup.
  const Lamp& lamp_of(int number) const { return table.lamps[std::size_t(number)]; }
  /// The visible fraction of a lamp, called by the lookup.
  float lamp_visible(const Lamp& lamp, vec3 position, vec3 geometric_normal) const {
    return visible(lamp, position, geometric_normal);
  }
#include "graphics/shading/lamps_lookup.glsl"
};

}  // namespace parvis::shading
