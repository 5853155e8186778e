#include "base/openimageio_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <mutex>

#include "base/checked.h"
#include "base/colour.h"
#include "base/descriptor.h"
#include "base/memory_budget.h"
#include "base/radiance_header.h"

namespace parvis {
namespace {

using namespace std::string_view_literals;

/// A format of pictures that Parvis reads and writes.
struct PictureFormat {
  std::string_view name;        ///< OpenImageIO's
  std::string_view extensions;  ///< in lower case, each after a space
  std::string_view magic;       ///< the file's first bytes, '.' for any; empty: known by extension
  bool is_read_only = false;    ///< the library reads it out of files alone, and Parvis writes none
};

/// Raw files come first, since many of them begin like TIFF.
constexpr std::array formats{PictureFormat{"raw", " arw cr2 cr3 dng nef orf pef raf rw2 srw", ""sv, true},
                             PictureFormat{"heif", " heic heif avif", "....ftypheic"sv, true},
                             PictureFormat{"heif", " heic heif avif", "....ftypheix"sv, true},
                             PictureFormat{"heif", " heic heif avif", "....ftypmif1"sv, true},
                             PictureFormat{"heif", " heic heif avif", "....ftypavif"sv, true},
                             PictureFormat{"png", " png", "\x89PNG\r\n\x1a\n"sv},
                             PictureFormat{"jpeg", " jpg jpeg", "\xff\xd8\xff"sv},
                             PictureFormat{"openexr", " exr", "\x76\x2f\x31\x01"sv},
                             PictureFormat{"hdr", " hdr", "#?"sv},
                             PictureFormat{"tiff", " tif tiff", "II*\0"sv},
                             PictureFormat{"tiff", " tif tiff", "MM\0*"sv},
                             PictureFormat{"bmp", " bmp", "BM"sv},
                             PictureFormat{"gif", " gif", "GIF8"sv},
                             PictureFormat{"webp", " webp", "RIFF....WEBP"sv},
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

bool begins_with(std::span<const std::uint8_t> bytes, const PictureFormat& format) {
  if (bytes.size() < format.magic.size()) return false;
  for (std::size_t i = 0; i < format.magic.size(); ++i)
    if (bytes[i] != std::uint8_t(format.magic[i]) && format.magic[i] != '.') return false;
  return true;
}

/// The format is known by the first bytes; `name`'s extension decides only for formats without such bytes
/// (TGA, raw files of cameras). Null for any other.
const PictureFormat* format_of(std::span<const std::uint8_t> bytes, std::string_view name) {
  const auto found = std::ranges::find_if(formats, [&](const PictureFormat& format) {
    return format.magic.empty() ? has_extension(format, name) : begins_with(bytes, format);
  });
  return found == formats.end() || bytes.empty() ? nullptr : &*found;
}

/// The format is that of the extension of a file to be written, in any case; null where Parvis does not write
/// such files.
const PictureFormat* format_to_write(std::string_view name) {
  const auto found = std::ranges::find_if(formats, [&](const PictureFormat& format) {
    return format.name != "gif" && !format.is_read_only && has_extension(format, name);
  });
  return found == formats.end() ? nullptr : &*found;
}

/// A worker calls it: threads that the library had before the fork are gone, and a limit on memory has no
/// room for many.
void use_one_thread() {
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
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
  return Ok{};
}

/// Spreads `count` pixels of 1 to n channels over 3 or 4: grey to RGB, missing alpha to `opaque`.
template <class T>
void spread_channels(const T* in, int from, std::size_t count, T* out, int to, T opaque) {
  const bool is_grey = from < 3, has_alpha = from == 2 || from >= 4;
  for (std::size_t i = 0; i < count; ++i, in += from, out += to) {
    for (int c = 0; c < 3; ++c) out[c] = in[is_grey ? 0 : c];
    if (to == 4) out[3] = has_alpha ? in[is_grey ? 1 : 3] : opaque;
  }
}

Error not_a_picture(const std::string& name, std::string reason) {
  std::ranges::replace(reason, '\n', ' ');
  return error(
      "{}: cannot be read as a picture{}; expected PNG, JPEG, EXR, HDR, TIFF, BMP, GIF, WebP, HEIC, "
      "AVIF, TGA or a camera's raw file",
      name, reason.empty() ? "" : fmt::format(" ({})", reason));
}

/// A picture that is open, and the bytes or the file in memory that it reads.
struct OpenPicture {
  Descriptor file;
  std::unique_ptr<OIIO::Filesystem::IOMemReader> reader;
  std::unique_ptr<OIIO::ImageInput> input;
};

/// A file of these bytes that has no name, for libraries that read nothing else; none where memory ends.
Descriptor file_in_memory(std::span<const std::uint8_t> bytes) {
  Descriptor file(memfd_create("picture", MFD_CLOEXEC));
  while (!bytes.empty()) {
    const ssize_t written = write(file.get(), bytes.data(), bytes.size());
    if (written <= 0) return Descriptor();
    bytes = bytes.subspan(std::size_t(written));
  }
  return file;
}

/// One at a time: a JPEG's colour profile is read by a converter that all threads of OpenImageIO 2.4 share,
/// and two that open pictures at once crash now and then. Only the header is read here; pixels are decoded
/// side by side.
Result<OpenPicture> open_picture(std::span<const std::uint8_t> bytes, const std::string& name) {
  static std::mutex opening;
  const PictureFormat* format = format_of(bytes, name);
  if (format == nullptr) return not_a_picture(name, bytes.empty() ? "it is empty" : "");
  const std::lock_guard lock(opening);
  OpenPicture open;
  open.input = OIIO::ImageInput::create(std::string(format->name));
  if (!open.input) return not_a_picture(name, OIIO::geterror());
  std::string file_name = "picture." + std::string(format->extensions.substr(1, 3));
  if (format->is_read_only) {
    open.file = file_in_memory(bytes);
    if (!open.file) return error("{}: there is no memory for its {} bytes", name, bytes.size());
    file_name = fmt::format("/proc/self/fd/{}", open.file.get());
  } else {
    open.reader = std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<std::uint8_t*>(bytes.data()),
                                                                  bytes.size());
    if (!open.input->set_ioproxy(open.reader.get())) return not_a_picture(name, OIIO::geterror());
  }
  // A palette's transparency and premultiplication are the file's business: ask for plain colours.
  OIIO::ImageSpec spec, configuration;
  configuration.attribute("oiio:UnassociatedAlpha", 1);
  if (!open.input->open(file_name, spec, configuration)) {
    const std::string_view front(reinterpret_cast<const char*>(bytes.data()),
                                 std::min<std::size_t>(bytes.size(), 4096));
    if (front.find("FORMAT=32-bit_rle_xyze") != std::string_view::npos)
      return error("{}: its pixels are CIE XYZ, which are not read; ra_xyze -r of Radiance makes RGB of them",
                   name);
    return not_a_picture(name, open.input->geterror());
  }
  if (Status status = check_size(spec, bytes.size(), name); !status) return status.errors();
  return open;
}

/// Rows that are decoded at once where their channels have to be spread: they stay in the cache.
constexpr int rows_at_once = 64;

/// Reads all pixels into `out`, which has `channels` for each of them.
template <class T>
bool read_pixels(OIIO::ImageInput& input, T* out, int channels, T opaque) {
  const OIIO::ImageSpec& spec = input.spec();
  const OIIO::TypeDesc type = OIIO::BaseTypeFromC<T>::value;
  if (spec.nchannels == channels) return input.read_image(0, 0, 0, channels, type, out);
  const std::size_t width = std::size_t(spec.width), from = std::size_t(spec.nchannels);
  const int rows = spec.tile_width > 0 ? spec.height : std::min(rows_at_once, spec.height);
  std::vector<T> some(width * std::size_t(rows) * from);
  for (int y = 0; y < spec.height; y += rows) {
    const int end = std::min(y + rows, spec.height), first = spec.y + y;
    const bool is_read = spec.tile_width > 0 ? input.read_image(0, 0, 0, spec.nchannels, type, some.data())
                                             : input.read_scanlines(0, 0, first, spec.y + end, 0, 0,
                                                                    spec.nchannels, type, some.data());
    if (!is_read) return false;
    const std::size_t count = width * std::size_t(end - y);
    spread_channels(some.data(), spec.nchannels, count, out + width * std::size_t(y) * std::size_t(channels),
                    channels, opaque);
  }
  return true;
}

/// Puts the pixels of a Radiance picture where its header says that they stand.
template <class T>
void move_pixels(const RadianceHeader& header, const std::vector<T>& from, const OIIO::ImageSpec& spec,
                 int channels, T* to) {
  const int lines = spec.height, along = spec.width;
  const int width = header.is_transposed ? lines : along, height = header.is_transposed ? along : lines;
  for (int line = 0; line < lines; ++line)
    for (int i = 0; i < along; ++i) {
      int x = header.is_transposed ? line : i, y = header.is_transposed ? i : line;
      if (header.starts_right) x = width - 1 - x;
      if (header.starts_below) y = height - 1 - y;
      const std::size_t source = std::size_t(line) * std::size_t(along) + std::size_t(i),
                        target = std::size_t(y) * std::size_t(width) + std::size_t(x);
      std::copy_n(from.data() + source * std::size_t(channels), channels,
                  to + target * std::size_t(channels));
    }
}

template <class T>
Status decode(std::span<const std::uint8_t> bytes, const std::string& name, const PixelsFor<T>& pixels_for) {
  use_one_thread();
  constexpr bool is_float = std::is_same_v<T, float>;
  constexpr int channels = is_float ? 3 : 4;
  Result<OpenPicture> open = open_picture(bytes, name);
  if (!open) return open.errors();
  OIIO::ImageInput& input = *open->input;
  const OIIO::ImageSpec& spec = input.spec();
  const auto needed = checked_product({std::uint64_t(spec.width), std::uint64_t(spec.height),
                                       std::uint64_t(spec.nchannels + channels), sizeof(T)});
  if (Status status =
          check_memory(needed, fmt::format("{}: its {} x {} pixels", name, spec.width, spec.height));
      !status)
    return status;
  const bool is_srgb = is_float && spec.format.basesize() == 1;
  const std::size_t values = std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(channels);
  const bool is_radiance = format_of(bytes, name)->name == "hdr"sv;
  const RadianceHeader header = is_radiance ? radiance_header(bytes) : RadianceHeader{};
  const Result<T*> pixels = header.is_transposed ? pixels_for(spec.height, spec.width, channels)
                                                 : pixels_for(spec.width, spec.height, channels);
  if (!pixels) return pixels.errors();
  std::vector<T> in_file_order(header.moves_pixels() ? values : 0);
  if (!read_pixels(input, header.moves_pixels() ? in_file_order.data() : *pixels, channels,
                   T(is_float ? 1 : 255)))
    return error("{}: the picture is damaged or cut short ({})", name, input.geterror());
  if (header.moves_pixels()) move_pixels(header, in_file_order, spec, channels, *pixels);
  if constexpr (is_float)
    for (std::size_t i = 0; is_radiance && i < values; ++i) (*pixels)[i] *= header.scale[i % 3];
  if constexpr (is_float)
    if (is_srgb)
      for (float& value : std::span(*pixels, values)) value = linear_from_srgb(value);
  return Ok{};
}

/// Pixels and EXIF of a picture of any format, as JPEG.
Result<std::string> as_jpeg(std::span<const std::uint8_t> bytes, const std::string& name) {
  use_one_thread();
  constexpr int channels = 4, quality = 95;
  Result<OpenPicture> open = open_picture(bytes, name);
  if (!open) return open.errors();
  OIIO::ImageInput& input = *open->input;
  OIIO::ImageSpec spec = input.spec();
  const auto needed = checked_product(
      {std::uint64_t(spec.width), std::uint64_t(spec.height), std::uint64_t(spec.nchannels + channels)});
  if (Status status =
          check_memory(needed, fmt::format("{}: its {} x {} pixels", name, spec.width, spec.height));
      !status)
    return status.errors();
  std::vector<std::uint8_t> pixels(std::size_t(spec.width) * std::size_t(spec.height) * channels);
  if (!read_pixels(input, pixels.data(), channels, std::uint8_t{255}))
    return error("{}: the picture is damaged or cut short ({})", name, input.geterror());
  spec.nchannels = 3;
  spec.channelnames = {"R", "G", "B"};
  spec.set_format(OIIO::TypeDesc::UINT8);
  spec.attribute("CompressionQuality", quality);
  const auto output = OIIO::ImageOutput::create("jpeg");
  OIIO::Filesystem::IOVecOutput jpeg;
  if (!output || !output->set_ioproxy(&jpeg) || !output->open("picture.jpg", spec) ||
      !output->write_image(OIIO::TypeDesc::UINT8, pixels.data(), channels) || !output->close())
    return error("{}: cannot be encoded ({})", name, output ? output->geterror() : OIIO::geterror());
  return std::string(jpeg.buffer().begin(), jpeg.buffer().end());
}

template <class T>
Result<std::string> encode(const PictureView<T>& picture, const std::string& name) {
  use_one_thread();
  const PictureFormat* format = format_to_write(name);
  if (format == nullptr)
    return error("{}: no such pictures are written; choose .png, .jpg, .exr, .hdr, .tif, .bmp, .webp or .tga",
                 name);
  const auto output = OIIO::ImageOutput::create(std::string(format->name));
  OIIO::Filesystem::IOVecOutput bytes;
  const int channels =
      format->name == "hdr"sv ? std::min(picture.channels, 3) : picture.channels;  // it has no alpha
  OIIO::ImageSpec spec(picture.width, picture.height, channels, OIIO::BaseTypeFromC<T>::value);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("CompressionQuality", 92);
  // The library would write the clock's: the same command gives the same bytes.
  if (format->name == "openexr"sv) spec.attribute("DateTime", "2003:01:01 00:00:00");
  const std::string file_name = "picture." + std::string(format->extensions.substr(1, 3));
  if (!output || !output->set_ioproxy(&bytes) || !output->open(file_name, spec) ||
      !output->write_image(OIIO::BaseTypeFromC<T>::value, picture.pixels,
                           OIIO::stride_t(picture.channels) * OIIO::stride_t(sizeof(T))) ||
      !output->close())
    return error("{}: cannot be encoded ({})", name, output ? output->geterror() : OIIO::geterror());
  return std::string(bytes.buffer().begin(), bytes.buffer().end());
}

/// The letters in white on black: what OpenImageIO would blend with another colour.
Result<TextCoverage> cover_text(const std::string& text, int height_px, const std::string& font_file) {
  const OIIO::ROI around = OIIO::ImageBufAlgo::text_size(text, height_px, font_file);
  TextCoverage covered;
  if (!around.defined() || around.width() < 1 || around.height() < 1) return covered;
  covered.corner = {around.xbegin, around.ybegin};
  covered.coverage = Image8(around.width(), around.height(), 1);
  OIIO::ImageBuf canvas(OIIO::ImageSpec(around.width(), around.height(), 1, OIIO::TypeDesc::UINT8),
                        covered.coverage.pixels.data());
  OIIO::ImageBufAlgo::render_text(canvas, -around.xbegin, -around.ybegin, text, height_px, font_file, {1.0f});
  return covered;
}

}  // namespace
}  // namespace parvis

PARVIS_MODULE(parvis::OpenImageIoFunctions){
    parvis::decode<std::uint8_t>, parvis::decode<float>, parvis::encode<std::uint8_t>,
    parvis::encode<float>,        parvis::as_jpeg,       parvis::cover_text};
