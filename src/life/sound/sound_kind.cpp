#include "life/sound/sound_kind.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/random.h"
#include "life/propagation/road_emission.h"
#include "life/propagation/tram_emission.h"

namespace parvis::sound {
namespace {

constexpr std::size_t piece = 128;  // samples over which the envelope of noise is constant: 2.7 ms

/// Levels of a man who speaks at 1 m, normal effort (ISO 3382-3:2012, table 1), and 11 dB to his power.
constexpr Octaves speech_db{45.0, 60.9, 65.3, 69.0, 63.0, 55.8, 49.8, 44.5};

/// A number in [0, 1) of a seed and a count.
double uniform_of(std::uint64_t seed, long count) {
  return double(Random{seed * 0x9e3779b97f4a7c15u + std::uint64_t(count)}.uniform());
}

/// Envelopes of noise, as amplitudes of at most 1.
double steps_envelope(std::uint64_t seed, double time_s) {
  const double pace_s = 0.5 + 0.1 * uniform_of(seed, 0);
  const double since_s = time_s - pace_s * std::floor(time_s / pace_s);
  const double heel = std::exp(-since_s / 0.012), toe = 0.4 * std::exp(-std::abs(since_s - 0.09) / 0.02);
  return heel + toe;
}

double speech_envelope(std::uint64_t seed, double time_s) {
  constexpr double syllable_s = 0.22;
  const double offset_s = time_s + 97.0 * uniform_of(seed, 0);
  const auto syllable = long(std::floor(offset_s / syllable_s));
  const double within = offset_s / syllable_s - double(syllable);
  const bool is_pause = uniform_of(seed, syllable / 9) < 0.35 && syllable % 9 > 4;
  const double loudness = is_pause ? 0.0 : 0.35 + 0.65 * uniform_of(seed, syllable);
  return loudness * std::sin(std::numbers::pi * within) * std::sin(std::numbers::pi * within);
}

/// One tone of a sum.
struct Tone {
  double hz, amplitude, decay_s;
};

double amplitude_at(double hz, const Octaves& amplitudes) {
  const double place = std::clamp(std::log2(hz / 62.5), 0.0, double(octaves) - 1.0);
  const auto low = std::min(std::size_t(place), octaves - 2);
  return std::lerp(amplitudes[low], amplitudes[low + 1], place - double(low));
}

/// Partials of a minor-third church bell, relative to its strike note (Fletcher and Rossing 1998,
/// table 21.1).
constexpr Tone bell_partials[]{{0.5, 0.5, 6.0}, {1.0, 0.7, 3.0}, {1.2, 1.0, 2.2}, {1.5, 0.4, 1.4},
                               {2.0, 0.9, 1.2}, {2.5, 0.3, 0.7}, {3.0, 0.4, 0.5}, {4.0, 0.3, 0.35}};
/// Partials of a tram's gong: those of a free bar (the same, table 2.1).
constexpr Tone gong_partials[]{{1.0, 0.8, 0.5}, {2.756, 0.6, 0.3}, {5.404, 0.3, 0.15}};

/// Adds a tone whose amplitude and phase go evenly from one value to the other.
void add_tone(std::span<float> samples, double from, double to, double begin_rad, double end_rad) {
  if (from == 0.0 && to == 0.0) return;
  const double count = double(samples.size());
  std::complex<float> phasor(std::polar(1.0, begin_rad)),
      turn(std::polar(1.0, (end_rad - begin_rad) / count));
  float amplitude = float(from);
  const float slope = float((to - from) / count);
  for (float& sample : samples) {
    sample += amplitude * phasor.imag();
    phasor = {phasor.real() * turn.real() - phasor.imag() * turn.imag(),
              phasor.real() * turn.imag() + phasor.imag() * turn.real()};
    amplitude += slope;
  }
}

/// Two moments of emission, with the amplitudes by octave then.
struct Stretch {
  double begin_s, end_s;
  Octaves from, to;
};

/// A bell that is struck at each multiple of an interval.
struct Bell {
  double note_hz, interval_s;
  std::span<const Tone> partials;
};

void add_bell(const Bell& bell, const Stretch& stretch, std::span<float> samples) {
  constexpr double full_turn = 2.0 * std::numbers::pi, inaudible = 7.0;  // in decays: -61 dB
  const auto [note_hz, interval_s, partials] = bell;
  const auto last = long(std::floor(stretch.end_s / interval_s)),
             audible = long(std::ceil(inaudible * partials.front().decay_s / interval_s));
  for (long strike = std::max(last - audible, 0L); strike <= last; ++strike) {
    const double begin_s = stretch.begin_s - double(strike) * interval_s,
                 end_s = stretch.end_s - double(strike) * interval_s;
    for (const Tone& tone : partials) {
      const double hz = note_hz * tone.hz;
      const auto amplitude = [&](double since_s, const Octaves& amplitudes) {
        if (since_s <= 0.0 || since_s > inaudible * tone.decay_s) return 0.0;
        return tone.amplitude * amplitude_at(hz, amplitudes) * std::exp(-since_s / tone.decay_s) *
               (1.0 - std::exp(-since_s / 0.002));
      };
      add_tone(samples, amplitude(begin_s, stretch.from), amplitude(end_s, stretch.to),
               full_turn * hz * begin_s, full_turn * hz * end_s);
    }
  }
}

/// Wheels that stick and slip: tones that come and go.
void add_squeal(std::uint64_t seed, const Stretch& stretch, std::span<float> samples) {
  constexpr double slot_s = 0.35;
  constexpr std::array partials{1.0, 2.03, 3.1};
  for (std::size_t k = 0; k < partials.size(); ++k) {
    const double hz = partials[k] * (1700.0 + 900.0 * uniform_of(seed, 0)),
                 turn = 2.0 * std::numbers::pi * hz;
    const auto amplitude = [&](double time_s, const Octaves& amplitudes) {
      const double place = time_s / slot_s, whole = std::floor(place), part = place - whole;
      const auto loudness = [&](long slot) { return uniform_of(seed + k, slot); };
      return amplitude_at(hz, amplitudes) *
             std::lerp(loudness(long(whole)), loudness(long(whole) + 1), part * part * (3.0 - 2.0 * part));
    };
    add_tone(samples, amplitude(stretch.begin_s, stretch.from), amplitude(stretch.end_s, stretch.to),
             turn * stretch.begin_s, turn * stretch.end_s);
  }
}

void add_bird(std::uint64_t seed, const Stretch& stretch, std::span<float> samples) {
  constexpr double slot_s = 0.16;
  const auto slot = long(std::floor(stretch.begin_s / slot_s));
  // Phrases of some seconds, then silence; in a phrase most slots hold a chirp.
  if (uniform_of(seed, 7 * (slot / 14)) > 0.45 || uniform_of(seed, slot) > 0.7) return;
  const double length_s = 0.05 + 0.08 * uniform_of(seed, slot + 1);
  const double from_hz = 2500.0 + 3000.0 * uniform_of(seed, slot + 2),
               sweep_hz_s = 20000.0 * (uniform_of(seed, slot + 3) - 0.5);
  const auto within = [&](double time_s) { return time_s - double(slot) * slot_s; };
  const auto amplitude = [&](double within_s, const Octaves& amplitudes) {
    if (within_s >= length_s) return 0.0;
    return amplitude_at(from_hz, amplitudes) * std::sin(std::numbers::pi * within_s / length_s);
  };
  const auto phase = [&](double within_s) {
    return 2.0 * std::numbers::pi * (from_hz + 0.5 * sweep_hz_s * within_s) * within_s;
  };
  const double begin_s = within(stretch.begin_s), end_s = within(stretch.end_s);
  add_tone(samples, amplitude(begin_s, stretch.from), amplitude(end_s, stretch.to), phase(begin_s),
           phase(end_s));
}

/// Calls use(stretch, samples) for pieces of a sound.
template <class Use>
void for_each_piece(double begin_s, double end_s, const Octaves& from, const Octaves& to,
                    std::span<float> samples, const Use& use) {
  const double count = double(samples.size());
  for (std::size_t done = 0; done < samples.size(); done += piece) {
    const std::size_t next = std::min(done + piece, samples.size());
    const double first = double(done) / count, last = double(next) / count;
    Stretch stretch{std::lerp(begin_s, end_s, first), std::lerp(begin_s, end_s, last), {}, {}};
    for (std::size_t band = 0; band < octaves; ++band) {
      stretch.from[band] = std::lerp(from[band], to[band], first);
      stretch.to[band] = std::lerp(from[band], to[band], last);
    }
    use(stretch, samples.subspan(done, next - done));
  }
}

/// Noise with an envelope.
template <class Envelope>
void add_shaped_noise(std::uint64_t seed, Stretch stretch, std::span<float> samples,
                      const Envelope& envelope) {
  const double begin = envelope(seed, stretch.begin_s), end = envelope(seed, stretch.end_s);
  if (begin < 1e-4 && end < 1e-4) return;
  for (double& amplitude : stretch.from) amplitude *= begin;
  for (double& amplitude : stretch.to) amplitude *= end;
  const double offset = double(BandNoise::length) * uniform_of(seed, -1);
  BandNoise::instance().add(samples, offset + stretch.begin_s * sample_rate,
                            (stretch.end_s - stretch.begin_s) * sample_rate / double(samples.size()),
                            stretch.from, stretch.to);
}

}  // namespace

SoundKind sound_kind(std::string_view name) {
  return SoundKind(std::ranges::find(sound_names, name) - sound_names.begin());
}

bool has_events(SoundKind kind) { return kind >= SoundKind::murmur; }

Octaves power_db(SoundKind kind, double speed_m_s) {
  using propagation::VehicleCategory;
  switch (kind) {
    case SoundKind::car:
      return propagation::vehicle_power_db(propagation::road_coefficients_2020, VehicleCategory::light,
                                           3.6 * speed_m_s);
    case SoundKind::bus:
      return propagation::vehicle_power_db(propagation::road_coefficients_2020, VehicleCategory::heavy,
                                           3.6 * speed_m_s);
    case SoundKind::tram:
      return propagation::tram_power_db(speed_m_s);
    case SoundKind::tram_roof:
      return {78, 79, 77, 74, 72, 68, 62, 54};  // air conditioning
    case SoundKind::tram_doors:
      return {60, 62, 64, 67, 69, 70, 70, 65};
    case SoundKind::tram_bell:
      return {0, 0, 0, 70, 92, 96, 92, 80};
    case SoundKind::tram_squeal:
      return {0, 0, 0, 0, 76, 96, 92, 80};
    case SoundKind::fountain:
      return {58, 60, 64, 70, 74, 76, 75, 71};
    case SoundKind::leaves:
      return {30, 34, 38, 42, 46, 49, 50, 47};
    case SoundKind::murmur:
      return speech_db;
    case SoundKind::footsteps:
      return footsteps_db(0.0);
    case SoundKind::birds:
      return {0, 0, 0, 0, 20, 70, 80, 66};
    case SoundKind::bell:
      return {70, 80, 96, 104, 102, 96, 84, 70};
    case SoundKind::recording:
    case SoundKind::bed:
      break;  // as loud as the file says
  }
  return {};
}

Octaves footsteps_db(double ground_factor) {
  constexpr Octaves stone{62, 64, 66, 65, 62, 58, 52, 44}, gravel{56, 58, 62, 66, 69, 70, 68, 62},
      lawn{54, 54, 52, 48, 44, 42, 40, 34};
  using propagation::gravel_factor;
  Octaves result;
  for (std::size_t band = 0; band < octaves; ++band)
    result[band] =
        ground_factor < gravel_factor
            ? std::lerp(stone[band], gravel[band], ground_factor / gravel_factor)
            : std::lerp(gravel[band], lawn[band], (ground_factor - gravel_factor) / (1.0 - gravel_factor));
  return result;
}

void add_sound(SoundKind kind, std::uint64_t seed, double begin_s, double end_s, const Octaves& from,
               const Octaves& to, std::span<float> samples) {
  for_each_piece(begin_s, end_s, from, to, samples, [&](const Stretch& stretch, std::span<float> part) {
    switch (kind) {
      case SoundKind::footsteps:
        return add_shaped_noise(seed, stretch, part, steps_envelope);
      case SoundKind::murmur:
        return add_shaped_noise(seed, stretch, part, speech_envelope);
      case SoundKind::birds:
        return add_bird(seed, stretch, part);
      case SoundKind::bell:
        return add_bell({330.0 * std::exp2(uniform_of(seed, 0)), 2.4, bell_partials}, stretch, part);
      case SoundKind::tram_bell:
        return add_bell({1100.0 + 200.0 * uniform_of(seed, 0), 0.45, gong_partials}, stretch, part);
      case SoundKind::tram_squeal:
        return add_squeal(seed, stretch, part);
      case SoundKind::recording:
      case SoundKind::bed:
        return;
      default:
        return add_shaped_noise(seed, stretch, part, [](std::uint64_t, double) { return 1.0; });
    }
  });
}

}  // namespace parvis::sound
