// Light of the kitchen. The renderer lights a scene by its sky map; here the map is the room's own radiance
// as seen from its middle: a bright window, pale walls and ceiling, a warm floor. The sun shines in through
// the window.
#pragma once

#include <cstdint>

#include "base/image.h"

namespace parvis::kitchen {

/// Dimensions of the room: x east, y north to the tiled wall, z up; the window is in the west wall.
inline constexpr float room_east_m = 1.8f, room_south_m = -3.0f, room_height_m = 2.6f;
inline constexpr float window_south_m = -1.75f, window_north_m = -0.45f, window_foot_m = 1.0f,
                       window_top_m = 2.15f;

/// The sun's direction, through the window.
inline constexpr float kitchen_sun_azimuth_deg = 241.0f, kitchen_sun_elevation_deg = 24.0f;

/// Equirectangular radiance map of the room, in the layout of scene::Sky.
ImageF room_light_picture(int width_px);

/// Radiance of white in `window_view_picture`.
inline constexpr float window_view_radiance = 2.2f;
/// The view through the window (sky above a hillside), sRGB and RGBA.
Image8 window_view_picture(std::uint64_t seed);

}  // namespace parvis::kitchen
