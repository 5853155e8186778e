#include "life/sound/soundfiles_module.h"

#include <ebur128.h>
#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>

namespace parvis::sound {
namespace {

/// Bytes in memory as libsndfile reads them.
struct Bytes {
  std::string_view all;
  sf_count_t at = 0;

  static Bytes& of(void* data) { return *static_cast<Bytes*>(data); }
  static sf_count_t length(void* data) { return sf_count_t(of(data).all.size()); }
  static sf_count_t tell(void* data) { return of(data).at; }
  static sf_count_t seek(sf_count_t offset, int whence, void* data) {
    Bytes& bytes = of(data);
    const sf_count_t from = whence == SEEK_CUR ? bytes.at : whence == SEEK_END ? length(data) : 0;
    if (offset < -from || offset > length(data) - from) return -1;
    return bytes.at = from + offset;
  }
  static sf_count_t read(void* to, sf_count_t count, void* data) {
    Bytes& bytes = of(data);
    count = std::clamp<sf_count_t>(count, 0, length(data) - bytes.at);
    std::memcpy(to, bytes.all.data() + bytes.at, std::size_t(count));
    bytes.at += count;
    return count;
  }
  static sf_count_t write(const void*, sf_count_t, void*) { return 0; }
};

/// A sinc of 24 zero crossings under a Hann window, as a table from its middle on.
class Kernel {
 public:
  static constexpr int crossings = 24;

  Kernel() : values_(crossings * steps + 2, 0.0f) {
    for (std::size_t i = 0; i < std::size_t(crossings * steps); ++i) {
      const double away = double(i) / steps, x = std::numbers::pi * away;
      const double sinc = i == 0 ? 1.0 : std::sin(x) / x;
      values_[i] = float(sinc * (0.5 + 0.5 * std::cos(x / crossings)));
    }
  }

  float at(float away) const {
    const float place = std::min(std::abs(away), float(crossings)) * float(steps);
    const auto whole = std::size_t(place);
    return std::lerp(values_[whole], values_[whole + 1], place - float(whole));
  }

 private:
  static constexpr int steps = 512;
  std::vector<float> values_;
};

/// A signal at another rate, without what lies above either Nyquist frequency.
std::vector<float> resampled(const std::vector<float>& signal, int rate) {
  if (rate == sample_rate) return signal;
  const Kernel kernel;
  const double step = double(rate) / sample_rate, cut = std::min(1.0, 1.0 / step),
               reach = Kernel::crossings / cut;
  std::vector<float> result(std::size_t(double(signal.size()) / step));
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double at = double(i) * step;
    const auto first = std::max<std::ptrdiff_t>(0, std::ptrdiff_t(std::ceil(at - reach))),
               last = std::min(std::ptrdiff_t(signal.size()) - 1, std::ptrdiff_t(std::floor(at + reach)));
    float sum = 0.0f;
    for (std::ptrdiff_t k = first; k <= last; ++k)
      sum += signal[std::size_t(k)] * kernel.at(float(cut * (double(k) - at)));
    result[i] = float(cut) * sum;
  }
  return result;
}

/// The end goes over into the begin, so that nothing clicks where the recording begins again.
void close_loop(std::vector<float>& signal) {
  const std::size_t fade = std::min<std::size_t>(signal.size() / 4, std::size_t(sample_rate / 20));
  const std::size_t kept = signal.size() - fade;
  for (std::size_t i = 0; i < fade; ++i) {
    const float part = float(i) / float(fade);
    signal[i] = std::sqrt(part) * signal[i] + std::sqrt(1.0f - part) * signal[kept + i];
  }
  signal.resize(kept);
}

Result<double> loudness_of(const Recording& recording, const std::string& name) {
  struct Close {
    void operator()(ebur128_state* state) const { ebur128_destroy(&state); }
  };
  const std::unique_ptr<ebur128_state, Close> state(ebur128_init(2, sample_rate, EBUR128_MODE_I));
  if (!state) return error("{}: there is no memory to measure its loudness", name);
  ebur128_set_channel(state.get(), 0, EBUR128_LEFT), ebur128_set_channel(state.get(), 1, EBUR128_RIGHT);
  std::vector<float> both(2 * recording.left.size());
  for (std::size_t i = 0; i < recording.left.size(); ++i)
    both[2 * i] = recording.left[i], both[2 * i + 1] = recording.right[i];
  double lufs = 0.0;
  if (ebur128_add_frames_float(state.get(), both.data(), recording.left.size()) != EBUR128_SUCCESS ||
      ebur128_loudness_global(state.get(), &lufs) != EBUR128_SUCCESS)
    return error("{}: its loudness cannot be measured", name);
  if (std::isfinite(lufs)) return lufs - 10.0 * std::log10(2.0);  // both channels' energies were added
  // Shorter than the 0.4 s of a block, or below the gate of -70 LUFS.
  double sum = 0.0;
  for (const float sample : both) sum += double(sample) * double(sample);
  if (!(sum > 1e-9 * double(both.size())))
    return error("{}: is silent; expected a recording that can be heard", name);
  return 10.0 * std::log10(sum / double(both.size()));
}

Result<Recording> decode(std::string_view bytes, const std::string& name) {
  if (bytes.empty()) return error("{}: is empty; expected a sound file (WAVE, FLAC, Ogg)", name);
  SF_VIRTUAL_IO io{Bytes::length, Bytes::seek, Bytes::read, Bytes::write, Bytes::tell};
  Bytes source{bytes};
  SF_INFO info{};
  const std::unique_ptr<SNDFILE, int (*)(SNDFILE*)> file(sf_open_virtual(&io, SFM_READ, &info, &source),
                                                         sf_close);
  if (!file)
    return error("{}: cannot be read as a sound file ({}); expected WAVE, FLAC or Ogg Vorbis", name,
                 sf_strerror(nullptr));
  constexpr int max_channels = 16, min_rate = 4000, max_rate = 192'000;
  if (info.channels < 1 || info.channels > max_channels || info.samplerate < min_rate ||
      info.samplerate > max_rate)
    return error("{}: has {} channels at {} Hz; expected 1 to {} at {} to {} Hz", name, info.channels,
                 info.samplerate, max_channels, min_rate, max_rate);
  const auto max_frames = std::size_t(max_recording_s * info.samplerate);
  Recording recording;
  std::vector<float> block(4096 * std::size_t(info.channels));
  while (const sf_count_t count = sf_readf_float(file.get(), block.data(), 4096)) {
    if (count < 0) break;
    for (std::size_t i = 0; i < std::size_t(count); ++i) {
      const float* const frame = block.data() + i * std::size_t(info.channels);
      const float left = frame[0], right = frame[info.channels > 1 ? 1 : 0];
      if (!std::isfinite(left) || !std::isfinite(right))
        return error("{}: sample {} is no number; export the sound again", name, recording.left.size());
      recording.left.push_back(std::clamp(left, -8.0f, 8.0f));
      recording.right.push_back(std::clamp(right, -8.0f, 8.0f));
    }
    if (recording.left.size() > max_frames)
      return error("{}: lasts longer than {:.0f} s; cut it to what is to be heard", name, max_recording_s);
  }
  constexpr std::size_t min_frames = 64;
  if (recording.left.size() < min_frames)
    return error("{}: holds {} samples, too few to be heard; it may be cut off: copy it again", name,
                 recording.left.size());
  for (std::vector<float>* channel : {&recording.left, &recording.right}) {
    *channel = resampled(*channel, info.samplerate);
    close_loop(*channel);
  }
  const Result<double> lufs = loudness_of(recording, name);
  if (!lufs) return lufs.errors();
  recording.loudness_lufs = *lufs;
  return recording;
}

}  // namespace
}  // namespace parvis::sound

PARVIS_MODULE(parvis::sound::SoundFileFunctions){parvis::sound::decode};
