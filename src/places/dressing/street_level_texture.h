// Street level of brick houses: four bands on one sheet, each as wide as four bays and one storey high.
#pragma once

#include <cstdint>

#include "base/random.h"
#include "synthesis/surface_canvas.h"
#include "synthesis/window_texture.h"

namespace parvis::dressing {

/// The content of a band, from the foot of the sheet up.
enum class StreetBand : std::uint8_t {
  houses,      ///< a front door and three windows
  wide_panes,  ///< a door with a side light, wide windows
  shops,       ///< fronts of glass under a fascia
  sheds        ///< plain, a garage door, plain, a small window
};
inline constexpr int door_bay = 0;    ///< in the bands of houses
inline constexpr int garage_bay = 1;  ///< in the band of sheds
inline constexpr int small_window_bay = 3;

/// How the street level of houses of one time looks.
struct StreetLook {
  synthesis::WindowStyle window;
  glm::vec3 door;            ///< linear
  bool has_lintels = false;  ///< of bricks, over doors and windows
};

/// Paints a band of houses with a door in each `door_bay`, and above it one of shops, over a wall that covers
/// the canvas.
void paint_street_level(synthesis::SurfaceCanvas& canvas, const StreetLook& look, Random& random);

/// Paints all bands over a wall that covers the canvas.
void paint_street_level(synthesis::SurfaceCanvas& canvas, Random& random);

}  // namespace parvis::dressing
