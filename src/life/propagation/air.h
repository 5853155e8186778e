// Absorption of sound in air: ISO 9613-1:1993.
#pragma once

#include "life/propagation/octaves.h"

namespace parvis::propagation {

/// The state of the air. The defaults are those of CNOSSOS-EU.
struct Air {
  double celsius = 15.0;           ///< temperature, °C
  double humidity_percent = 70.0;  ///< relative humidity
};

/// Absorption of a pure tone in dB/m at 101.325 kPa (ISO 9613-1, equations 3 to 5).
double absorption_db_per_m(double frequency_hz, const Air& air);

/// Absorption in dB/m of each octave at its exact mid-band frequency, 1000 · 10^(0.3 k) Hz: at the nominal
/// 8 kHz it would be more by 1.3 % than in the tables of ISO 9613-2.
Octaves absorption_db_per_m(const Air& air);

}  // namespace parvis::propagation
