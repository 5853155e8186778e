// Noise by octave bands: what all sounds without a pitch are made of. The level of each band is a factor, so
// that propagation by octave is a product and no filter.
#pragma once

#include <span>
#include <vector>

#include "life/propagation/octaves.h"

namespace parvis::sound {

using propagation::octaves;
using propagation::Octaves;

/// Samples per second of all that is computed.
inline constexpr int sample_rate = 48'000;

/// Eight loops of noise, one for each octave, of unit mean square: sums of partials at random frequencies of
/// the band.
class BandNoise {
 public:
  static constexpr std::size_t length = 1u << 16;  ///< samples of a loop, 1.37 s

  /// The loops, made at the first call, always the same.
  static const BandNoise& instance();

  /// Adds noise to `samples`, begun at a place of the loops, `rate` places per sample (the Doppler factor),
  /// while the amplitudes go evenly from `from` to `to`. Returns the place after the last sample.
  double add(std::span<float> samples, double place, double rate, const Octaves& from,
             const Octaves& to) const;

  /// Places of the partials of a band: multiples of sample_rate / length in Hz.
  std::span<const int> partials(std::size_t band) const { return partials_[band]; }

 private:
  BandNoise();

  std::vector<std::array<float, octaves>> frames_;  // all bands of a sample together
  std::array<std::vector<int>, octaves> partials_;
};

/// Energy of a loop-long stretch of a signal in an octave: mean square of its parts at the partials of band
/// noise. For signals made of band noise it is exact.
double band_energy(std::span<const float> samples, std::size_t band);

}  // namespace parvis::sound
