// Sound power of trams that roll. It is indicative: no standard has plain trams.
#pragma once

#include <algorithm>

#include "life/propagation/octaves.h"

namespace parvis::propagation {

/// Height of the sources over the rails, metres: rolling noise of CNOSSOS-EU's railways.
inline constexpr double tram_source_m = 0.5;

/// Sound power level in dB re 1 pW of one tram at a speed: 95 dB(A) at 40 km/h, 30 lg of the speed; silent
/// where it stands.
inline Octaves tram_power_db(double speed_m_s) {
  Octaves levels{84, 88, 91, 93, 91, 87, 80, 72};
  for (double& level : levels)
    level += speed_m_s < 0.3 ? silence_db : 30.0 * std::log10(std::max(speed_m_s, 1.0) / (40.0 / 3.6));
  return levels;
}

}  // namespace parvis::propagation
