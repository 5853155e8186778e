// Recordings: sound files as signals that propagation weakens by octave.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "base/result.h"
#include "life/sound/band_noise.h"

namespace parvis::sound {

/// A file's signal at `sample_rate`, which is heard over and over.
struct Recording {
  std::vector<float> left,
      right;                   ///< equally long; of a file with one channel, `right` is the same as `left`
  double loudness_lufs = 0.0;  ///< of the whole, EBU R 128
  std::filesystem::path file;  ///< that it was read from; empty: it came as bytes

  /// Seconds.
  double length_s() const { return double(left.size()) / sample_rate; }
  /// Mean square of a tone of 1 kHz of that loudness.
  double mean_square() const { return propagation::energy(loudness_lufs); }

  /// Adds both channels' mean as emitted between two times in seconds. The amplitudes by octave, which go
  /// evenly from `from` to `to`, are those of a recording as loud whose octaves are equal. What is added
  /// follows from the times alone.
  void add(double begin_s, double end_s, const Octaves& from, const Octaves& to,
           std::span<float> samples) const;
};

/// Files that are larger, and sounds that last longer, are refused.
inline constexpr std::uint64_t max_recording_bytes = 64u << 20;
inline constexpr double max_recording_s = 600.0;

/// The same of a file's bytes.
Result<Recording> decode_recording(const std::string& bytes, const std::string& name);

/// Reads a sound file (WAVE, FLAC, Ogg Vorbis and the like) in a child process. Errors name the file: it is
/// missing, too large, no sound, empty, silent, or holds samples that are no numbers.
Result<Recording> read_recording(const std::filesystem::path& file);

}  // namespace parvis::sound
