// The module `openimageio`: pictures out of bytes and into bytes, and words as pictures, by OpenImageIO. Its
// functions run where they are called; image_io.h and image_text.h call them in a child process.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>

#include "base/image.h"
#include "base/module.h"
#include "base/result.h"

namespace parvis {

/// The largest width or height that is read: a hostile header must not make us allocate the machine's memory.
inline constexpr int max_picture_side = 32768;

/// Where a decoder writes a picture's width * height * channels values; an error where there is no room for
/// them.
template <class T>
using PixelsFor = std::function<Result<T*>(int width, int height, int channels)>;

/// Decodes bytes whose format is recognised by their content, among an allow list, into memory that the
/// function gives once the picture's size is known and within the budget. T is std::uint8_t, RGBA, top row
/// first, straight alpha; or float: linear, 3 channels, from sRGB where the format has 8 bits; values may be
/// infinite or no numbers. Errors name `name` and what was expected.
template <class T>
using DecodePicture = Status(std::span<const std::uint8_t> bytes, const std::string& name,
                             const PixelsFor<T>& pixels_for);

/// Pixels of a picture that lie elsewhere, as those of BasicImage do.
template <class T>
struct PictureView {
  int width, height, channels;
  const T* pixels;
};

/// A file's bytes in the format of `name`'s extension, with 8 bits per channel or in linear float.
template <class T>
using EncodePicture = Result<std::string>(const PictureView<T>& picture, const std::string& name);

/// A line of text: how much of each pixel it covers, from 0 to 255, in one channel.
struct TextCoverage {
  glm::ivec2 corner{0};  ///< top left, from the left end of the baseline
  Image8 coverage;       ///< empty: nothing can be seen of it
};

/// The functions that the module offers.
struct OpenImageIoFunctions {
  DecodePicture<std::uint8_t>* decode_8;
  DecodePicture<float>* decode_float;
  EncodePicture<std::uint8_t>* encode_8;
  EncodePicture<float>* encode_float;
  /// Bytes of any format that is read as a JPEG of 8 bits, with the EXIF that they hold.
  Result<std::string> (*as_jpeg)(std::span<const std::uint8_t> bytes, const std::string& name);
  /// Draws one line, `height_px` high, in the font of a file.
  Result<TextCoverage> (*cover_text)(const std::string& text, int height_px, const std::string& font_file);
};

/// Loaded in the workers' server when the first picture is read or written.
inline constexpr Module<OpenImageIoFunctions> openimageio("openimageio");

}  // namespace parvis
