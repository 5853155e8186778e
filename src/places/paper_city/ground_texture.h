// What lies underfoot: asphalt with its markings, granite paving, lawn, gravel, courtyards. Each sheet tiles.
#pragma once

#include <cstdint>

#include "places/paper_city/surface_canvas.h"

namespace parvis::city {

/// A carriageway from kerb to kerb: u across (0 at the left kerb), v along. Kerb lines, a broken line in the
/// middle (3 m, gaps of 10 m), worn tracks, patches, manholes; with parking bays along both kerbs where it is
/// wide enough.
inline constexpr float road_sheet_length_m = 26.0f;
SurfacePictures road_pictures(float carriageway_m, bool has_parking, std::uint32_t seed);

/// The last metres before a crossing; v = 1 lies at the crossing, u = 0 on the right of those who drive
/// toward it. A zebra, then the stop line of their lane.
inline constexpr float zebra_length_m = 5.5f;
SurfacePictures zebra_pictures(float carriageway_m, std::uint32_t seed);

inline constexpr float asphalt_sheet_m = 10.24f, paving_sheet_m = 7.2f, lawn_sheet_m = 10.24f,
                       gravel_sheet_m = 5.12f, courtyard_sheet_m = 96.0f;
SurfacePictures asphalt_pictures(std::uint32_t seed);
SurfacePictures paving_pictures(std::uint32_t seed);
SurfacePictures lawn_pictures(std::uint32_t seed);
SurfacePictures gravel_pictures(std::uint32_t seed);
SurfacePictures courtyard_pictures(std::uint32_t seed);

}  // namespace parvis::city
