// Sound files that are written: WAVE, two channels of 16 bits.
#pragma once

#include <span>
#include <string>

#include "base/result.h"

namespace parvis::sound {

/// The bytes of a file of both channels, which are equally long; samples beyond ±1 are clipped, and counted
/// in `clipped`.
std::string encode_wave(std::span<const float> left, std::span<const float> right,
                        std::size_t* clipped = nullptr);

}  // namespace parvis::sound
