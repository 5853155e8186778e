// Pictures decoded into memory that the caller gives, so that a child process hands pixels back without a
// copy.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "base/result.h"

namespace parvis {

/// Where a decoder writes a picture's width * height * channels values; an error where there is no room for
/// them.
template <class T>
using PixelsFor = std::function<Result<T*>(int width, int height, int channels)>;

/// Decodes into memory that `pixels_for` gives once the picture's size is known and within the budget. T is
/// std::uint8_t, in the layout of decode_image8, or float: linear, 3 channels, from sRGB where the format has
/// 8 bits; values may be infinite or no numbers.
template <class T>
Status decode_image(std::span<const std::uint8_t> bytes, const std::string& name,
                    const PixelsFor<T>& pixels_for);

}  // namespace parvis
