// Level of detail of local maps (Meyer and Loscos 2003, section 5).
#pragma once

namespace parvis::environment_maps {

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

}  // namespace parvis::environment_maps
