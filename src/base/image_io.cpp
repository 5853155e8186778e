#include "base/image_io.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/checked.h"
#include "base/files.h"
#include "base/isolated_process.h"
#include "base/memory_budget.h"
#include "base/openimageio_module.h"

namespace parvis {
namespace {

namespace fs = std::filesystem;

/// The header of what a worker returns; pixels follow.
struct PictureHeader {
  int width, height, channels;
};

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Hands a worker's bytes to its caller.
Status give(const std::string& bytes, const std::string& name, IsolatedOutput& output) {
  const std::span<std::byte> to = output.allocate(bytes.size());
  if (to.size() != bytes.size()) return error("{}: there is no memory for its {} bytes", name, bytes.size());
  std::memcpy(to.data(), bytes.data(), bytes.size());
  return Ok{};
}

/// Runs in the worker: decodes `bytes` into `output`, without another copy of the pixels.
template <class T>
Status decode_into(std::string_view bytes, const std::string& name, IsolatedOutput& output) {
  const PixelsFor<T> pixels_for = [&](int width, int height, int channels) -> Result<T*> {
    const PictureHeader header{width, height, channels};
    const std::size_t values = std::size_t(width) * std::size_t(height) * std::size_t(channels);
    const std::span<std::byte> to = output.allocate(sizeof header + values * sizeof(T));
    if (to.empty()) return error("{}: there is no memory for {} x {} pixels", name, width, height);
    std::memcpy(to.data(), &header, sizeof header);
    return reinterpret_cast<T*>(to.data() + sizeof header);
  };
  if constexpr (std::is_same_v<T, float>)
    return openimageio.call(&OpenImageIoFunctions::decode_float, bytes_of(bytes), name, pixels_for);
  else
    return openimageio.call(&OpenImageIoFunctions::decode_8, bytes_of(bytes), name, pixels_for);
}

/// The work of a worker. The input is the picture's name, a zero, and the file's bytes.
template <class T>
Status decode_bytes(std::string_view input, IsolatedOutput& output) {
  const std::string name(input.substr(0, input.find('\0')));
  return decode_into<T>(input.substr(name.size() + 1), name, output);
}

/// The work of a worker. The input is the picture's name, a zero, and the path of its file, which the worker
/// reads itself: its bytes take no way through the program.
template <class T>
Status decode_file(std::string_view input, IsolatedOutput& output) {
  const std::string name(input.substr(0, input.find('\0')));
  const Result<std::string> bytes = read_file(fs::path(input.substr(name.size() + 1)));
  return bytes ? decode_into<T>(*bytes, name, output) : Status(bytes.errors());
}

/// The same, as the bytes of a JPEG.
Status make_jpeg(std::string_view input, IsolatedOutput& output) {
  const std::string name(input.substr(0, input.find('\0')));
  const Result<std::string> bytes = read_file(fs::path(input.substr(name.size() + 1)));
  if (!bytes) return bytes.errors();
  const Result<std::string> jpeg = openimageio.call(&OpenImageIoFunctions::as_jpeg, bytes_of(*bytes), name);
  return jpeg ? give(*jpeg, name, output) : Status(jpeg.errors());
}

/// The picture that `work` makes of a name and of what follows it.
template <class T>
Result<BasicImage<T>> decode_isolated(IsolatedWork work, const std::string& name, std::string_view rest,
                                      const IsolationLimits& limits = {}) {
  const std::string head = name + '\0';
  const Result<IsolatedBytes> made = run_isolated(work, {head, rest}, name, limits);
  if (!made) return made.errors();
  PictureHeader header{};
  const std::span<const std::byte> bytes = made->bytes();
  if (bytes.size() < sizeof header) return error("{}: its reader crashed", name);
  std::memcpy(&header, bytes.data(), sizeof header);
  const auto claimed =
      checked_product({std::uint64_t(std::max(header.width, 0)), std::uint64_t(std::max(header.height, 0)),
                       std::uint64_t(std::max(header.channels, 0)), sizeof(T)});
  if (claimed != bytes.size() - sizeof header) return error("{}: its reader crashed", name);
  if (Status status =
          check_memory(claimed, fmt::format("{}: its {} x {} pixels", name, header.width, header.height));
      !status)
    return status.errors();
  BasicImage<T> image;
  image.width = header.width, image.height = header.height, image.channels = header.channels;
  const T* const first = reinterpret_cast<const T*>(bytes.data() + sizeof header);
  image.pixels.assign(first, first + *claimed / sizeof(T));
  return image;
}

template <class T>
Result<BasicImage<T>> decode_isolated(const fs::path& file) {
  std::error_code code;
  const fs::path path = fs::absolute(file, code);
  return decode_isolated<T>(decode_file<T>, file.string(), path.string(), {.readable = {path}});
}

/// How many values were replaced by finite ones.
std::size_t make_finite(ImageF& image) {
  float largest = 0.0f;
  std::size_t replaced = 0;
  for (const float value : image.pixels) {
    if (std::isfinite(value)) largest = std::max(largest, value);
    replaced += !std::isfinite(value);
  }
  if (replaced > 0)
    for (float& value : image.pixels)
      if (!std::isfinite(value)) value = value > 0.0f ? largest : 0.0f;
  return replaced;
}

/// The header of what is to be encoded; name and pixels follow.
struct EncodedHeader {
  int width, height, channels;
  int name_bytes;  ///< a multiple of the size of a value, with zeros at the end: pixels are read in place
};

/// The work of a worker.
template <class T>
Status encode_pixels(std::string_view input, IsolatedOutput& output) {
  EncodedHeader header{};
  std::memcpy(&header, input.data(), sizeof header);
  const std::string name(input.substr(sizeof header).data());
  const PictureView<T> picture{
      header.width, header.height, header.channels,
      reinterpret_cast<const T*>(input.data() + sizeof header + std::size_t(header.name_bytes))};
  Result<std::string> bytes = [&] {
    if constexpr (std::is_same_v<T, float>)
      return openimageio.call(&OpenImageIoFunctions::encode_float, picture, name);
    else
      return openimageio.call(&OpenImageIoFunctions::encode_8, picture, name);
  }();
  return bytes ? give(*bytes, name, output) : Status(bytes.errors());
}

/// Memory that encoding may take beyond the usual, by the size of the pixels: the slowest format writes 2 MB
/// a second.
constexpr double encoding_s_per_mb = 5.0;

template <class T>
Result<std::string> encode_isolated(const BasicImage<T>& image, const std::string& name) {
  const std::size_t name_bytes = (name.size() / sizeof(T) + 1) * sizeof(T);
  const EncodedHeader header{image.width, image.height, image.channels, int(name_bytes)};
  std::string head(reinterpret_cast<const char*>(&header), sizeof header);
  head += name;
  head.resize(sizeof header + name_bytes);
  const std::string_view pixels(reinterpret_cast<const char*>(image.pixels.data()),
                                image.pixels.size() * sizeof(T));
  IsolationLimits limits{.writes = true};
  limits.seconds += encoding_s_per_mb * 1e-6 * double(pixels.size());
  const Result<IsolatedBytes> made = run_isolated(encode_pixels<T>, {head, pixels}, name, limits);
  if (!made) return made.errors();
  return std::string(reinterpret_cast<const char*>(made->bytes().data()), made->bytes().size());
}

template <class T>
Status write(const fs::path& file, const BasicImage<T>& image) {
  const Result<std::string> bytes = encode_isolated(image, file.string());
  return bytes ? write_file(file, *bytes) : Status(bytes.errors());
}

}  // namespace

Result<Image8> read_image8(const fs::path& file) { return decode_isolated<std::uint8_t>(file); }

Result<Image8> read_image8(std::span<const std::uint8_t> bytes, const std::string& name) {
  return decode_isolated<std::uint8_t>(decode_bytes<std::uint8_t>, name,
                                       {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Result<ImageF> read_image_float(const fs::path& file, std::size_t* replaced) {
  Result<ImageF> image = decode_isolated<float>(file);
  if (!image) return image;
  const std::size_t count = make_finite(*image);
  if (replaced != nullptr) *replaced = count;
  return image;
}

Result<std::string> jpeg_of(const fs::path& file) {
  std::error_code code;
  const fs::path path = fs::absolute(file, code);
  const std::string name = file.string();
  const Result<IsolatedBytes> made =
      run_isolated(make_jpeg, {name + '\0', path.string()}, name, {.readable = {path}});
  if (!made) return made.errors();
  return std::string(reinterpret_cast<const char*>(made->bytes().data()), made->bytes().size());
}

Result<std::string> encode_image(const Image8& image, const std::string& name) {
  return encode_isolated(image, name);
}

Result<std::string> encode_image(const ImageF& image, const std::string& name) {
  return encode_isolated(image, name);
}

Status write_image(const fs::path& file, const Image8& image) { return write(file, image); }

Status write_image(const fs::path& file, const ImageF& image) { return write(file, image); }

}  // namespace parvis
