// Kinds of sounds that need no recording: their sound power by octave and what they do in time.
#pragma once

#include <optional>
#include <string_view>

#include "life/sound/band_noise.h"

namespace parvis::sound {

/// The kinds.
enum class SoundKind {
  car,
  bus,
  tram,
  tram_roof,
  tram_doors,
  fountain,
  leaves,
  murmur,
  footsteps,
  birds,
  bell,
  tram_bell,
  tram_squeal,  ///< of wheels in tight curves
  recording,    ///< a sound file, heard from its place
  bed           ///< a sound file in stereo, heard everywhere: music, the hum of a town
};

/// Names in scripts, in the order of SoundKind.
inline constexpr std::array sound_names{"car",      "bus",       "tram",        "tram roof", "tram doors",
                                        "fountain", "leaves",    "murmur",      "footsteps", "birds",
                                        "bell",     "tram bell", "tram squeal", "recording", "bed"};

/// Kinds that need no recording; they come first. The first of them are steady noise.
inline constexpr std::size_t synthetic_kinds = 13, steady_kinds = 7;

/// The kind of a name of `sound_names`.
SoundKind sound_kind(std::string_view name);

/// True for sounds that consist of events, which are heard one by one; the others are steady noise, and many
/// of them together are noise again.
bool has_events(SoundKind kind);

/// Sound power in dB re 1 pW by octave; for events that of the loudest moment. Vehicles: CNOSSOS-EU's light
/// and heavy ones at a speed, which is that of 20 km/h where they are slower. Trams are indicative: no
/// standard has plain trams.
Octaves power_db(SoundKind kind, double speed_m_s);
/// The same of footsteps on ground with a factor G: stone, gravel, lawn.
Octaves footsteps_db(double ground_factor);

/// Adds a sound as it is emitted between two times (seconds since the scene began; the Doppler effect is in
/// their difference), with amplitudes by octave that go evenly from `from` to `to`. What it does follows from
/// the time and the seed alone.
void add_sound(SoundKind kind, std::uint64_t seed, double begin_s, double end_s, const Octaves& from,
               const Octaves& to, std::span<float> samples);

}  // namespace parvis::sound
