// Level of detail of local maps (Meyer and Loscos 2003, section 5).
#pragma once

#include <array>

#include "graphics/render/quality_budget.h"

namespace parvis::local_maps {

/// Resolution of a local map and of the mesh from which it is drawn.
struct LocalMapLevel {
  int tile = 0;                  ///< texels per side, border included; 0: no map, simple blending instead
  float smallest_texels = 1.0f;  ///< of the mesh's quads

  bool operator==(const LocalMapLevel&) const = default;
};

/// Texels per side of a tile for a requested resolution: the next power of two, as mipmaps and borders need
/// it, within limits.
int tile_of(int resolution);

/// The finest level.
inline LocalMapLevel full_level(int resolution) { return {tile_of(resolution), 1.0f}; }

/// Level for a body that is `size_px` wide in the image and moves by `speed_px` pixels per frame.
LocalMapLevel level_for(float size_px, float speed_px, int resolution);

/// The levels among which the time budget chooses for one body, the cheapest first, with their cost on two
/// cores of a software renderer.
struct LevelLadder {
  static constexpr std::size_t max_rungs = 4;
  std::array<LocalMapLevel, max_rungs> levels;
  std::array<render::QualityLevel, max_rungs> qualities;
  std::size_t rungs;
};
/// The ladder whose best level is `best`: simple blending, then a quarter, half and all of its resolution.
LevelLadder ladder_below(const LocalMapLevel& best);

}  // namespace parvis::local_maps
