// Pictures in and out: the only door to OpenImageIO.
#pragma once

#include <filesystem>
#include <span>

#include "base/image.h"
#include "base/result.h"

namespace parvis {

/// The largest width or height that is read: a hostile header must not make us allocate the machine's memory.
inline constexpr int max_picture_side = 32768;

/// Reads PNG, JPEG, TGA, BMP, ... as 8-bit RGBA, top row first. Errors name the file and what was expected.
Result<Image8> read_image8(const std::filesystem::path& file);
/// The same from a file held in memory; `name` stands in errors and its extension may be empty.
Result<Image8> read_image8(std::span<const std::uint8_t> bytes, const std::string& name);
/// Reads EXR, HDR, TIFF, PNG, ... as linear float with 3 channels (8-bit formats are decoded from sRGB).
Result<ImageF> read_image_float(const std::filesystem::path& file);

/// Writes by the extension (.png, .jpg: 8-bit). The file appears whole or not at all.
Status write_image(const std::filesystem::path& file, const Image8& image);
/// Writes .exr or .hdr in linear float. The file appears whole or not at all.
Status write_image(const std::filesystem::path& file, const ImageF& image);

}  // namespace parvis
