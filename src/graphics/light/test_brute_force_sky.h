// The atmosphere without tables: paths of light traced through it, by which the tables are judged. Shares
// with them only the constants of air.h.
#pragma once

#include <cstdint>

#include "graphics/light/air.h"

namespace parvis::light {

/// Light of the sky alone on a horizontal plane at the ground, as shares of the sun's irradiance, with the
/// standard error of its luminance.
struct BruteForceIrradiance {
  Spectrum share;
  double standard_error = 0.0;  ///< relative
};

/// Backward paths in double precision: distances chosen along the whole ray, transmittance by numerical
/// integration of each segment, all orders (Russian roulette after the sixth). The same seed gives the same
/// result.
BruteForceIrradiance brute_force_diffuse(const Air& air, double sun_elevation_deg, int paths,
                                         std::uint64_t seed);

}  // namespace parvis::light
