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

std::string encode_wave(std::span<const float> left, std::span<const float> right, std::size_t* clipped) {
  constexpr std::uint16_t channels = 2, bytes_per_sample = 2;
  const auto data_bytes = std::uint32_t(left.size() * channels * bytes_per_sample);
  std::string bytes = "RIFF";
  append_number(bytes, std::uint32_t(36 + data_bytes));
  bytes += "WAVEfmt ";
  append_number(bytes, std::uint32_t(16)), append_number(bytes, std::uint16_t(1)),
      append_number(bytes, channels);
  append_number(bytes, std::uint32_t(sample_rate));
  append_number(bytes, std::uint32_t(sample_rate * channels * bytes_per_sample));
  append_number(bytes, std::uint16_t(channels * bytes_per_sample)), append_number(bytes, std::uint16_t(16));
  bytes += "data";
  append_number(bytes, data_bytes);
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < left.size(); ++i)
    for (const float sample : {left[i], right[i]}) {
      beyond += std::abs(sample) > 1.0f;
      append_number(bytes, std::int16_t(std::lround(32767.0f * std::clamp(sample, -1.0f, 1.0f))));
    }
  if (clipped) *clipped = beyond;
  return bytes;
}

}  // namespace parvis::sound
