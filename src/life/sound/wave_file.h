// Sound files that are written: WAVE, 16 bits.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "life/sound/ears.h"

namespace parvis::sound {

/// The bytes of a file of all channels of an output, which are equally long and named in its header (channel
/// mask); samples beyond ±1 are clipped, and counted in `clipped`.
std::string encode_wave(std::span<const std::vector<float>> buffers, Output output,
                        std::size_t* clipped = nullptr);

/// The header of such a file with `frames` samples in each channel.
std::string wave_header(Output output, std::uint32_t frames);

/// Appends samples of all channels in turn as a file holds them; returns how many were clipped.
std::size_t append_samples(std::string& bytes, std::span<const std::span<const float>> buffers);

}  // namespace parvis::sound
