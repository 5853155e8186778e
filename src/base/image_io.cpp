#include "base/image_io.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/checked.h"
#include "base/files.h"
#include "base/isolated_process.h"
#include "base/memory_budget.h"

namespace parvis {
namespace {

namespace fs = std::filesystem;

/// At the front of what a worker gives; pixels follow.
struct PictureHeader {
  int width, height, channels;
};

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

template <class T>
Result<BasicImage<T>> decode(std::span<const std::uint8_t> bytes, const std::string& name) {
  if constexpr (std::is_same_v<T, float>)
    return decode_image_float(bytes, name);
  else
    return decode_image8(bytes, name);
}

/// In the worker. The input is the picture's name, a zero, and the file's bytes.
template <class T>
Status decode_in_worker(std::string_view input, IsolatedOutput& output) {
  OIIO::attribute("threads", 1);  // the library's threads did not survive the fork
  OIIO::attribute("exr_threads", -1);
  const std::string name(input.substr(0, input.find('\0')));
  const Result<BasicImage<T>> image = decode<T>(bytes_of(input.substr(name.size() + 1)), name);
  if (!image) return image.errors();
  const PictureHeader header{image->width, image->height, image->channels};
  const std::size_t pixel_bytes = image->pixels.size() * sizeof(T);
  const std::span<std::byte> bytes = output.allocate(sizeof header + pixel_bytes);
  if (bytes.empty())
    return error("{}: there is no memory for {} x {} pixels", name, header.width, header.height);
  std::memcpy(bytes.data(), &header, sizeof header);
  std::memcpy(bytes.data() + sizeof header, image->pixels.data(), pixel_bytes);
  return Done{};
}

template <class T>
Result<BasicImage<T>> decode_isolated(std::string_view file_bytes, const std::string& name) {
  std::string input = name + '\0';
  input += file_bytes;
  const Result<IsolatedBytes> made = run_isolated(decode_in_worker<T>, input, name);
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
  BasicImage<T> image(header.width, header.height, header.channels, T{});
  std::memcpy(image.pixels.data(), bytes.data() + sizeof header, image.pixels.size() * sizeof(T));
  return image;
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

template <class T>
Status write(const fs::path& file, const BasicImage<T>& image) {
  const Result<std::string> bytes = encode_image(image, file.string());
  return bytes ? write_file(file, *bytes) : Status(bytes.errors());
}

}  // namespace

Result<Image8> read_image8(const fs::path& file) {
  const Result<std::string> bytes = read_file(file);
  if (!bytes) return bytes.errors();
  return decode_isolated<std::uint8_t>(*bytes, file.string());
}

Result<Image8> read_image8(std::span<const std::uint8_t> bytes, const std::string& name) {
  return decode_isolated<std::uint8_t>({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
}

Result<ImageF> read_image_float(const fs::path& file, std::size_t* replaced) {
  const Result<std::string> bytes = read_file(file);
  if (!bytes) return bytes.errors();
  Result<ImageF> image = decode_isolated<float>(*bytes, file.string());
  if (!image) return image;
  const std::size_t count = make_finite(*image);
  if (replaced != nullptr) *replaced = count;
  return image;
}

Status write_image(const fs::path& file, const Image8& image) { return write(file, image); }

Status write_image(const fs::path& file, const ImageF& image) { return write(file, image); }

}  // namespace parvis
