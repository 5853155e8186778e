#include "base/picture_codec.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <mutex>

#include "base/checked.h"
#include "base/colour.h"
#include "base/memory_budget.h"

namespace parvis {
namespace {

using namespace std::string_view_literals;

constexpr std::array formats{PictureFormat{"png", " png", "\x89PNG\r\n\x1a\n"sv},
                             PictureFormat{"jpeg", " jpg jpeg", "\xff\xd8\xff"sv},
                             PictureFormat{"openexr", " exr", "\x76\x2f\x31\x01"sv},
                             PictureFormat{"hdr", " hdr", "#?"sv},
                             PictureFormat{"tiff", " tif tiff", "II*\0"sv},
                             PictureFormat{"tiff", " tif tiff", "MM\0*"sv},
                             PictureFormat{"bmp", " bmp", "BM"sv},
                             PictureFormat{"gif", " gif", "GIF8"sv},
                             PictureFormat{"webp", " webp", "RIFF????WEBP"sv},
                             PictureFormat{"targa", " tga", ""sv}};

/// Samples that any picture may have, and those that each byte of its file may stand for: deflate packs a
/// thousand bytes into one, each of up to eight pixels. More is a header that lies.
constexpr std::uint64_t small_picture_samples = std::uint64_t{1} << 26, max_samples_per_byte = 1 << 14;

bool has_extension(const PictureFormat& format, std::string_view name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos) return false;
  std::string extension(name.substr(dot + 1));
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  const std::size_t found = format.extensions.find(" " + extension);
  const std::size_t end = found + 1 + extension.size();
  return !extension.empty() && found != std::string_view::npos &&
         (end == format.extensions.size() || format.extensions[end] == ' ');
}

/// "#?" alone is a wildcard only in the middle of WebP's header, whose length stands there.
bool begins_with(std::span<const std::uint8_t> bytes, const PictureFormat& format) {
  if (bytes.size() < format.magic.size()) return false;
  for (std::size_t i = 0; i < format.magic.size(); ++i)
    if (bytes[i] != std::uint8_t(format.magic[i]) && !(format.name == "webp"sv && format.magic[i] == '?'))
      return false;
  return true;
}

Status check_size(const OIIO::ImageSpec& spec, std::size_t file_bytes, const std::string& name) {
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1)
    return error("{}: not a flat picture ({} x {} x {})", name, spec.width, spec.height, spec.depth);
  if (spec.width > max_picture_side || spec.height > max_picture_side)
    return error("{}: {} x {} pixels; at most {} a side are read", name, spec.width, spec.height,
                 max_picture_side);
  const std::uint64_t samples =
      std::uint64_t(spec.width) * std::uint64_t(spec.height) * std::uint64_t(spec.nchannels);
  if (samples > std::max(small_picture_samples, max_samples_per_byte * std::uint64_t(file_bytes)))
    return error("{}: claims {} x {} pixels of {} channels in {} bytes; the picture is damaged", name,
                 spec.width, spec.height, spec.nchannels, file_bytes);
  return Done{};
}

/// Spreads 1 to n channels over 3 or 4: grey to RGB, missing alpha to `opaque`.
template <class T>
BasicImage<T> with_channels(const std::vector<T>& source, int width, int height, int from, int to, T opaque) {
  BasicImage<T> image(width, height, to, opaque);
  const bool is_grey = from < 3;
  for (std::size_t i = 0; i < std::size_t(width) * std::size_t(height); ++i) {
    const T* in = source.data() + i * std::size_t(from);
    T* out = image.pixels.data() + i * std::size_t(to);
    for (int c = 0; c < 3; ++c) out[c] = in[is_grey ? 0 : c];
    if (to == 4 && (from == 2 || from >= 4)) out[3] = in[is_grey ? 1 : 3];
  }
  return image;
}

Error not_a_picture(const std::string& name, std::string reason) {
  std::ranges::replace(reason, '\n', ' ');
  return error("{}: cannot be read as a picture{}; expected PNG, JPEG, EXR, HDR, TIFF, BMP, GIF, WebP or TGA",
               name, reason.empty() ? "" : fmt::format(" ({})", reason));
}

/// A picture that is open, the bytes that it reads, and its format's name for its errors.
struct OpenPicture {
  std::unique_ptr<OIIO::Filesystem::IOMemReader> reader;
  std::unique_ptr<OIIO::ImageInput> input;
};

/// One at a time: a JPEG's colour profile is read by a converter that all threads of OpenImageIO 2.4 share,
/// and two that open pictures at once crash now and then. Only the header is read here; pixels are decoded
/// side by side.
Result<OpenPicture> open_picture(std::span<const std::uint8_t> bytes, const std::string& name) {
  static std::mutex opening;
  const PictureFormat* format = picture_format_of(bytes, name);
  if (format == nullptr) return not_a_picture(name, bytes.empty() ? "it is empty" : "");
  const std::lock_guard lock(opening);
  OpenPicture open;
  open.reader =
      std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
  open.input = OIIO::ImageInput::create(std::string(format->name));
  if (!open.input || !open.input->set_ioproxy(open.reader.get()))
    return not_a_picture(name, OIIO::geterror());
  // A palette's transparency and premultiplication are the file's business: ask for plain colours.
  OIIO::ImageSpec spec, configuration;
  configuration.attribute("oiio:UnassociatedAlpha", 1);
  const std::string file_name = "picture." + std::string(format->extensions.substr(1, 3));
  if (!open.input->open(file_name, spec, configuration)) return not_a_picture(name, open.input->geterror());
  if (Status status = check_size(spec, bytes.size(), name); !status) return status.errors();
  return open;
}

template <class T>
Result<BasicImage<T>> read_pixels(OIIO::ImageInput& input, const std::string& name, int channels, T opaque) {
  const OIIO::ImageSpec& spec = input.spec();
  const auto bytes = checked_product({std::uint64_t(spec.width), std::uint64_t(spec.height),
                                      std::uint64_t(spec.nchannels + channels), sizeof(T)});
  if (Status status =
          check_memory(bytes, fmt::format("{}: its {} x {} pixels", name, spec.width, spec.height));
      !status)
    return status.errors();
  std::vector<T> pixels(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels));
  if (!input.read_image(0, 0, 0, spec.nchannels, OIIO::BaseTypeFromC<T>::value, pixels.data()))
    return error("{}: the picture is damaged or cut short ({})", name, input.geterror());
  return with_channels(pixels, spec.width, spec.height, spec.nchannels, channels, opaque);
}

template <class T>
Result<std::string> encode(const BasicImage<T>& image, const std::string& name) {
  const PictureFormat* format = picture_format_to_write(name);
  if (format == nullptr)
    return error("{}: no such pictures are written; choose .png, .jpg, .exr, .hdr, .tif, .bmp, .webp or .tga",
                 name);
  const auto output = OIIO::ImageOutput::create(std::string(format->name));
  OIIO::Filesystem::IOVecOutput bytes;
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::BaseTypeFromC<T>::value);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("CompressionQuality", 92);
  // The library would write the clock's: the same command gives the same bytes.
  if (format->name == "openexr"sv) spec.attribute("DateTime", "2003:01:01 00:00:00");
  const std::string file_name = "picture." + std::string(format->extensions.substr(1, 3));
  if (!output || !output->set_ioproxy(&bytes) || !output->open(file_name, spec) ||
      !output->write_image(OIIO::BaseTypeFromC<T>::value, image.pixels.data()) || !output->close())
    return error("{}: cannot be encoded ({})", name, output ? output->geterror() : OIIO::geterror());
  return std::string(bytes.buffer().begin(), bytes.buffer().end());
}

}  // namespace

const PictureFormat* picture_format_of(std::span<const std::uint8_t> bytes, std::string_view name) {
  const auto found = std::ranges::find_if(formats, [&](const PictureFormat& format) {
    return format.magic.empty() ? has_extension(format, name) : begins_with(bytes, format);
  });
  return found == formats.end() || bytes.empty() ? nullptr : &*found;
}

const PictureFormat* picture_format_to_write(std::string_view name) {
  const auto found = std::ranges::find_if(formats, [&](const PictureFormat& format) {
    return format.name != "gif" && has_extension(format, name);
  });
  return found == formats.end() ? nullptr : &*found;
}

Result<Image8> decode_image8(std::span<const std::uint8_t> bytes, const std::string& name) {
  Result<OpenPicture> open = open_picture(bytes, name);
  if (!open) return open.errors();
  return read_pixels<std::uint8_t>(*open->input, name, 4, 255);
}

Result<ImageF> decode_image_float(std::span<const std::uint8_t> bytes, const std::string& name) {
  Result<OpenPicture> open = open_picture(bytes, name);
  if (!open) return open.errors();
  const bool is_srgb = open->input->spec().format.basesize() == 1;
  Result<ImageF> image = read_pixels<float>(*open->input, name, 3, 1.0f);
  if (image && is_srgb)
    for (float& value : image->pixels) value = linear_from_srgb(value);
  return image;
}

Result<std::string> encode_image(const Image8& image, const std::string& name) { return encode(image, name); }

Result<std::string> encode_image(const ImageF& image, const std::string& name) { return encode(image, name); }

}  // namespace parvis
