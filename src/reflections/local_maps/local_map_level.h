// Level of detail of local maps (Meyer and Loscos 2003, section 5).
#pragma once

#include <array>

#include "graphics/render/quality_budget.h"

namespace parvis::local_maps {

struct LocalMapLevel {
  int tile = 0;                  ///< texels a side, border included; 0: simply blended
  float smallest_texels = 1.0f;  ///< of the mesh's quads

  bool operator==(const LocalMapLevel&) const = default;
};

/// A power of two, as mipmaps and borders want it, about that of `resolution`.
int tile_of(int resolution);

/// The best that there is.
inline LocalMapLevel full_level(int resolution) { return {tile_of(resolution), 1.0f}; }

/// For a body `size_px` wide on the screen, whose picture moves by `speed_px` a frame.
LocalMapLevel level_for(float size_px, float speed_px, int resolution);

/// The levels that a budget may choose from for a body whose best is `best`, the cheapest first, and what
/// they cost on the two cores of a software renderer.
struct LevelLadder {
  static constexpr std::size_t max_rungs = 4;
  std::array<LocalMapLevel, max_rungs> levels;
  std::array<render::QualityLevel, max_rungs> qualities;
  std::size_t rungs;
};
LevelLadder ladder_below(const LocalMapLevel& best);

}  // namespace parvis::local_maps
