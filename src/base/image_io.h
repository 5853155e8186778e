// Pictures in and out of files. They are decoded and encoded in a child process (isolated_process.h): a file
// that makes the picture library crash or hang is an error that names it, and the library, which brings a
// hundred others along, stays out of the program.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "base/image.h"
#include "base/result.h"

namespace parvis {

/// Reads a picture as 8-bit RGBA, top row first. Formats: PNG, JPEG, EXR, HDR, TIFF, BMP, GIF, WebP, HEIC,
/// AVIF, recognised by their content; TGA and raw files of cameras, by their extension. HEIC, AVIF and raw
/// files are turned as their camera was held. Errors name the file and what was expected.
Result<Image8> read_image8(const std::filesystem::path& file);
/// The same from a file held in memory; `name` stands in errors and its extension may be empty.
Result<Image8> read_image8(std::span<const std::uint8_t> bytes, const std::string& name);
/// Reads a picture as linear float with 3 channels (8-bit formats are decoded from sRGB). All values are
/// finite: what is no number becomes 0, what is infinite the picture's largest number. `replaced`: how many
/// of them there were.
Result<ImageF> read_image_float(const std::filesystem::path& file, std::size_t* replaced = nullptr);

/// A picture of any of these formats as the bytes of a JPEG with its EXIF, for what reads nothing else.
Result<std::string> jpeg_of(const std::filesystem::path& file);

/// The file's bytes, in the format of `name`'s extension: 8 bits per channel.
Result<std::string> encode_image(const Image8& image, const std::string& name);
/// The same in linear float.
Result<std::string> encode_image(const ImageF& image, const std::string& name);

/// Writes by the extension (.png, .jpg, ...: 8 bits per channel). The file appears whole or not at all.
Status write_image(const std::filesystem::path& file, const Image8& image);
/// Writes .exr, .hdr, ... in linear float. The file appears whole or not at all.
Status write_image(const std::filesystem::path& file, const ImageF& image);

}  // namespace parvis
