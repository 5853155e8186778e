#include "life/sound/recording.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstring>
#include <numbers>

#include "base/files.h"
#include "base/isolated_process.h"
#include "life/sound/soundfiles_module.h"

namespace parvis::sound {
namespace {

namespace fs = std::filesystem;

/// The header of what a worker returns; the samples of both channels follow.
struct RecordingHeader {
  std::uint64_t samples;
  double loudness_lufs;
};

/// Runs in the worker.
Status decode_bytes(std::string_view bytes, const std::string& name, IsolatedOutput& output) {
  const Result<Recording> made = sound_files.call(&SoundFileFunctions::decode, bytes, name);
  if (!made) return made.errors();
  const RecordingHeader header{made->left.size(), made->loudness_lufs};
  const std::size_t channel_bytes = made->left.size() * sizeof(float);
  const std::span<std::byte> to = output.allocate(sizeof header + 2 * channel_bytes);
  if (to.empty()) return error("{}: there is no memory for its samples", name);
  std::memcpy(to.data(), &header, sizeof header);
  std::memcpy(to.data() + sizeof header, made->left.data(), channel_bytes);
  std::memcpy(to.data() + sizeof header + channel_bytes, made->right.data(), channel_bytes);
  return Ok{};
}

/// The input is the file's path.
Status decode_file(std::string_view input, IsolatedOutput& output) {
  const Result<std::string> bytes = read_file(fs::path(input), max_recording_bytes);
  return bytes ? decode_bytes(*bytes, std::string(input), output) : Status(bytes.errors());
}

/// The input is the file itself.
Status decode_sent(std::string_view input, IsolatedOutput& output) {
  return decode_bytes(input, "the recording", output);
}

Result<Recording> taken_from(const Result<IsolatedBytes>& made, const std::string& name) {
  if (!made) return made.errors();
  const std::span<const std::byte> bytes = made->bytes();
  RecordingHeader header{};
  if (bytes.size() >= sizeof header) std::memcpy(&header, bytes.data(), sizeof header);
  constexpr auto max_samples = std::uint64_t(max_recording_s * sample_rate);
  if (header.samples == 0 || header.samples > max_samples || !std::isfinite(header.loudness_lufs) ||
      bytes.size() != sizeof header + 2 * header.samples * sizeof(float))
    return error("{}: its reader crashed", name);
  const float* const first = reinterpret_cast<const float*>(bytes.data() + sizeof header);
  Recording recording;
  recording.left.assign(first, first + header.samples);
  recording.right.assign(first + header.samples, first + 2 * header.samples);
  recording.loudness_lufs = header.loudness_lufs;
  return recording;
}

constexpr std::size_t fft_size = 4096;  // 12 Hz apart: the lowest octave is 44 Hz wide
using Spectrum = std::vector<std::complex<float>>;

/// The sums of x[n] e^(sign 2 pi i k n / N), N a power of two (Cooley and Tukey 1965).
void transform(Spectrum& values, float sign) {
  const std::size_t count = values.size();
  for (std::size_t i = 1, k = 0; i < count; ++i) {  // in the order of reversed bits
    std::size_t bit = count / 2;
    for (; k & bit; bit /= 2) k ^= bit;
    k ^= bit;
    if (i < k) std::swap(values[i], values[k]);
  }
  static const Spectrum turns = [] {
    Spectrum result(fft_size / 2);
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = std::polar(1.0f, 2.0f * std::numbers::pi_v<float> * float(i) / float(fft_size));
    return result;
  }();
  for (std::size_t half = 1; half < count; half *= 2)
    for (std::size_t i = 0; i < half; ++i) {
      const std::complex<float> stored = turns[i * (fft_size / (2 * half))],
                                turn(stored.real(), sign * stored.imag());
      for (std::size_t first = i; first < count; first += 2 * half) {
        const std::complex<float> other = values[first + half], low = values[first];
        const std::complex<float> turned(other.real() * turn.real() - other.imag() * turn.imag(),
                                         other.real() * turn.imag() + other.imag() * turn.real());
        values[first] = low + turned, values[first + half] = low - turned;
      }
    }
}

/// The gain at a frequency between those of octaves.
float gain_at(double hz, const Octaves& gains) {
  const double place = std::clamp(std::log2(std::max(hz, 1.0) / 62.5), 0.0, double(octaves) - 1.0);
  const auto low = std::min(std::size_t(place), octaves - 2);
  return float(std::lerp(gains[low], gains[low + 1], place - double(low)));
}

}  // namespace

void Recording::add(double begin_s, double end_s, const Octaves& from, const Octaves& to,
                    std::span<float> samples) const {
  if (left.empty() || samples.empty()) return;
  const double count = double(samples.size()), length = double(left.size());
  const double rate = (end_s - begin_s) * sample_rate / count;
  const auto at = [&](double place) {
    place -= std::floor(place / length) * length;
    const std::size_t whole = std::min(std::size_t(place), left.size() - 1), next = (whole + 1) % left.size();
    const auto between = float(place - double(whole));
    return 0.5f * std::lerp(left[whole] + right[whole], left[next] + right[next], between);
  };
  // Gains turn no phases: what is added at a time follows from the recording on both sides of it, as far as
  // a stretch of the transform reaches.
  const double begin = begin_s * sample_rate;
  const double of_flat = std::sqrt(double(octaves) / mean_square());
  constexpr std::size_t stretch = fft_size / 2, before = fft_size / 4;
  for (std::size_t done = 0; done < samples.size(); done += stretch) {
    Spectrum values(fft_size);
    for (std::size_t i = 0; i < fft_size; ++i)
      values[i] = at(begin + (double(done) + double(i) - double(before)) * rate);
    transform(values, -1.0f);
    // One inverse transform for both gains: the signal with those of the begin is its real part.
    for (std::size_t i = 0; i <= fft_size / 2; ++i) {
      const double hz = double(i) * sample_rate / double(fft_size);
      const auto scale = float(of_flat / double(fft_size));
      const std::complex<float> gains(scale * gain_at(hz, from), scale * gain_at(hz, to));
      values[i] *= gains;
      if (i > 0 && i < fft_size / 2) values[fft_size - i] *= gains;
    }
    transform(values, 1.0f);
    for (std::size_t i = 0; i < std::min(stretch, samples.size() - done); ++i) {
      const std::complex<float> both = values[before + i];
      samples[done + i] += std::lerp(both.real(), both.imag(), float(double(done + i) / count));
    }
  }
}

Result<Recording> decode_recording(const std::string& bytes, const std::string& name) {
  return taken_from(run_isolated(decode_sent, bytes, name), name);
}

Result<Recording> read_recording(const fs::path& file) {
  std::error_code code;
  const fs::path path = fs::absolute(file, code);
  Result<Recording> recording = taken_from(
      run_isolated(decode_file, path.string(), file.string(), {.readable = {path}}), file.string());
  if (recording) recording->file = path;
  return recording;
}

}  // namespace parvis::sound
