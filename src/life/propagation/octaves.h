// Levels by octave: the eight bands of CNOSSOS-EU, and sums of levels.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace parvis::propagation {

/// Number of octave bands, 63 Hz to 8 kHz.
inline constexpr std::size_t octaves = 8;

/// One number for each band: a level in dB, an attenuation in dB, an absorption coefficient or an energy.
using Octaves = std::array<double, octaves>;

/// Nominal mid-band frequencies in Hz. Wavelengths and the effect of the ground are computed from them.
inline constexpr Octaves nominal_hz{63, 125, 250, 500, 1000, 2000, 4000, 8000};

/// A-weights in dB, rounded as CNOSSOS-EU's test cases round them.
inline constexpr Octaves a_weights_db{-26.2, -16.1, -8.6, -3.2, 0.0, 1.2, 1.0, -1.1};

/// G of gravel and sand; hard ground has 0, porous ground 1 (CNOSSOS-EU, table 2.5.a).
inline constexpr double gravel_factor = 0.7;

/// The level of silence in dB: sums of levels stay finite.
inline constexpr double silence_db = -200.0;

/// The energy of a level, relative to the level's reference.
inline double energy(double level_db) { return std::pow(10.0, 0.1 * level_db); }

/// The level of an energy in dB, not below `silence_db`.
inline double level(double energy) {
  constexpr double faintest = 1e-20;  // energy of silence_db
  return 10.0 * std::log10(energy > faintest ? energy : faintest);
}

/// The A-weighted level in dB of all bands together.
inline double a_weighted(const Octaves& levels_db) {
  double sum = 0.0;
  for (std::size_t i = 0; i < octaves; ++i) sum += energy(levels_db[i] + a_weights_db[i]);
  return level(sum);
}

}  // namespace parvis::propagation
