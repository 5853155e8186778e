#include "life/sound/wave_file.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "life/sound/band_noise.h"

namespace parvis::sound {
namespace {

static_assert(std::endian::native == std::endian::little);  // as WAVE is

template <class Number>
void append_number(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

std::string wave_header(Output output, std::uint32_t frames) {
  const std::span<const Channel> named = channels_of(output);
  const auto channels = std::uint16_t(named.size());
  constexpr std::uint16_t bytes_per_sample = 2, bits = 16, plain = 1, extensible = 0xfffe;
  const bool is_extensible = channels > 2;  // its mask says which loudspeakers they are
  const std::uint32_t format_bytes = is_extensible ? 40 : 16,
                      data_bytes = frames * channels * bytes_per_sample;
  std::uint32_t mask = 0;
  for (const Channel& channel : named) mask |= channel.mask;
  std::string bytes = "RIFF";
  append_number(bytes, 20 + format_bytes + data_bytes);
  bytes += "WAVEfmt ";
  append_number(bytes, format_bytes), append_number(bytes, is_extensible ? extensible : plain);
  append_number(bytes, channels), append_number(bytes, std::uint32_t(sample_rate));
  append_number(bytes, std::uint32_t(sample_rate * channels * bytes_per_sample));
  append_number(bytes, std::uint16_t(channels * bytes_per_sample)), append_number(bytes, bits);
  if (is_extensible) {
    append_number(bytes, std::uint16_t(22)), append_number(bytes, bits), append_number(bytes, mask);
    append_number(bytes, plain);
    bytes.append("\x00\x00\x00\x00\x10\x00\x80\x00\x00\xaa\x00\x38\x9b\x71", 14);  // KSDATAFORMAT_SUBTYPE_PCM
  }
  bytes += "data";
  append_number(bytes, data_bytes);
  return bytes;
}

std::size_t append_samples(std::string& bytes, std::span<const std::span<const float>> buffers) {
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < buffers[0].size(); ++i)
    for (const std::span<const float> buffer : buffers) {
      beyond += std::abs(buffer[i]) > 1.0f;
      append_number(bytes, std::int16_t(std::lround(32767.0f * std::clamp(buffer[i], -1.0f, 1.0f))));
    }
  return beyond;
}

std::string encode_wave(std::span<const std::vector<float>> buffers, Output output, std::size_t* clipped) {
  std::string bytes = wave_header(output, std::uint32_t(buffers[0].size()));
  const std::vector<std::span<const float>> channels(buffers.begin(), buffers.end());
  const std::size_t beyond = append_samples(bytes, channels);
  if (clipped) *clipped = beyond;
  return bytes;
}

}  // namespace parvis::sound
