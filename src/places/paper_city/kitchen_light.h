// The light of the kitchen. The renderer lights a place by the picture of its sky; here that picture is the
// room's own light, as it comes from all sides to its middle: a bright window, pale walls and ceiling, a warm
// floor. The sun shines in through the window.
#pragma once

#include <cstdint>

#include "base/image.h"

namespace parvis::city {

/// The room: x to the east, y to the tiled wall in the north, z up; the window is in the west wall.
inline constexpr float room_east_m = 1.8f, room_south_m = -3.0f, room_height_m = 2.6f;
inline constexpr float window_south_m = -1.75f, window_north_m = -0.45f, window_foot_m = 1.0f,
                       window_top_m = 2.15f;

inline constexpr float kitchen_sun_azimuth_deg = 241.0f, kitchen_sun_elevation_deg = 24.0f;

/// Equirectangular radiance, as scene::Sky wants it.
ImageF room_light_picture(int width_px);

/// What is seen through the window: sky, hills, fields; white is `window_view_radiance`.
inline constexpr float window_view_radiance = 2.2f;
Image8 window_view_picture(std::uint64_t seed);

}  // namespace parvis::city
