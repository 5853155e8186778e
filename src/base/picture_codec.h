// Pictures out of bytes and into bytes, by OpenImageIO: an allow list of formats, recognised by their
// content. Runs where it is called; image_io.h runs it in a child process for pictures of users.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/image.h"
#include "base/result.h"

namespace parvis {

/// The largest width or height that is read: a hostile header must not make us allocate the machine's memory.
inline constexpr int max_picture_side = 32768;

/// A format of pictures that Parvis reads and writes.
struct PictureFormat {
  std::string_view name;        ///< OpenImageIO's
  std::string_view extensions;  ///< in lower case, each after a space
  std::string_view magic;       ///< the file's first bytes, '?' for any; empty: known by extension
};

/// By the first bytes; `name`'s extension decides only for formats without such bytes (TGA). Null for any
/// other.
const PictureFormat* picture_format_of(std::span<const std::uint8_t> bytes, std::string_view name);
/// By the extension of a file to be written, in any case; null where Parvis does not write such files.
const PictureFormat* picture_format_to_write(std::string_view name);

/// 8-bit RGBA, top row first, straight alpha. Errors name `name` and what was expected.
Result<Image8> decode_image8(std::span<const std::uint8_t> bytes, const std::string& name);

/// The file's bytes, in the format of `name`'s extension: 8 bits per channel.
Result<std::string> encode_image(const Image8& image, const std::string& name);
/// The same in linear float.
Result<std::string> encode_image(const ImageF& image, const std::string& name);

}  // namespace parvis
