// Ground textures: asphalt with its markings, granite paving, lawn, gravel, courtyards. Each sheet tiles.
#pragma once

#include <cstdint>

#include "synthesis/surface_canvas.h"

namespace parvis::synthesis {

/// Length along the road that a sheet of `road_pictures` covers.
inline constexpr float road_sheet_length_m = 26.0f;
/// A carriageway from kerb to kerb, `carriageway_m` wide: u across (0 at the left kerb), v along. Kerb lines,
/// a broken centre line (3 m, gaps of 10 m), worn tracks, patches, manholes; parking bays along both kerbs if
/// `has_parking`.
SurfacePictures road_pictures(float carriageway_m, bool has_parking, std::uint32_t seed);

/// Length along the road that a sheet of `zebra_pictures` covers.
inline constexpr float zebra_length_m = 5.5f;
/// The last metres of a road before a crossing: v = 1 at the crossing, u = 0 on the right of traffic toward
/// it. A zebra crossing, then the stop line of that lane.
SurfacePictures zebra_pictures(float carriageway_m, std::uint32_t seed);

/// Side of the square that each of the following sheets covers, metres.
inline constexpr float asphalt_sheet_m = 10.24f, paving_sheet_m = 7.2f, lawn_sheet_m = 10.24f,
                       gravel_sheet_m = 5.12f, courtyard_sheet_m = 96.0f;
SurfacePictures asphalt_pictures(std::uint32_t seed);  ///< unmarked, for crossings
SurfacePictures paving_pictures(std::uint32_t seed);   ///< granite slabs of pavements
SurfacePictures lawn_pictures(std::uint32_t seed);     ///< grass of parks
SurfacePictures gravel_pictures(std::uint32_t seed);   ///< paths of parks
/// Back yards inside a block: plots with borders and plants.
SurfacePictures courtyard_pictures(std::uint32_t seed);

}  // namespace parvis::synthesis
