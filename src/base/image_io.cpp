#include "base/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <memory>
#include <mutex>

#include "base/colour.h"
#include "base/files.h"

namespace parvis {
namespace {

namespace fs = std::filesystem;

Status check_size(const OIIO::ImageSpec& spec, const std::string& name) {
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1)
    return error("{}: not a flat picture ({} x {} x {})", name, spec.width, spec.height, spec.depth);
  if (spec.width > max_picture_side || spec.height > max_picture_side)
    return error("{}: {} x {} pixels; at most {} a side are read", name, spec.width, spec.height,
                 max_picture_side);
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

template <class T>
Result<BasicImage<T>> read(OIIO::ImageInput* input, const std::string& name, int channels, T opaque) {
  // A palette's transparency and premultiplication are the file's business: ask for plain colours.
  const OIIO::ImageSpec& spec = input->spec();
  if (Status status = check_size(spec, name); !status) return status.errors();
  std::vector<T> pixels(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels,
                         OIIO::BaseTypeFromC<T>::value == OIIO::TypeDesc::UINT8 ? OIIO::TypeDesc::UINT8
                                                                                : OIIO::TypeDesc::FLOAT,
                         pixels.data()))
    return error("{}: the picture is damaged or cut short ({})", name, input->geterror());
  return with_channels(pixels, spec.width, spec.height, spec.nchannels, channels, opaque);
}

OIIO::ImageSpec plain_colours() {
  OIIO::ImageSpec configuration;
  configuration.attribute("oiio:UnassociatedAlpha", 1);
  return configuration;
}

Error cannot_open(const std::string& name) {
  std::string reason = OIIO::geterror();
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  return error("{}: cannot be read as a picture ({}); expected PNG, JPEG, TGA, EXR or HDR", name, reason);
}

template <class T>
Status write(const fs::path& file, const BasicImage<T>& image, OIIO::TypeDesc type) {
  return write_atomically(file, [&](const fs::path& temporary) -> Status {
    auto output = OIIO::ImageOutput::create(temporary.string());
    if (!output) return error("{}: no writer for this kind of picture ({})", file.string(), OIIO::geterror());
    OIIO::ImageSpec spec(image.width, image.height, image.channels, type);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("CompressionQuality", 92);
    if (!output->open(temporary.string(), spec) || !output->write_image(type, image.pixels.data()) ||
        !output->close())
      return error("{}: cannot be written ({})", file.string(), output->geterror());
    return Done{};
  });
}

/// One file at a time: a JPEG's colour profile is read by a converter that all threads of OpenImageIO 2.4
/// share, and two that open pictures at once crash now and then. Only the header is read here; pixels are
/// decoded side by side.
std::unique_ptr<OIIO::ImageInput> open_picture(const std::string& file,
                                               const OIIO::ImageSpec* configuration = nullptr,
                                               OIIO::Filesystem::IOProxy* proxy = nullptr) {
  static std::mutex opening;
  const std::lock_guard lock(opening);
  return OIIO::ImageInput::open(file, configuration, proxy);
}

}  // namespace

Result<Image8> read_image8(const fs::path& file) {
  const OIIO::ImageSpec configuration = plain_colours();
  auto input = open_picture(file.string(), &configuration);
  if (!input) return cannot_open(file.string());
  return read<std::uint8_t>(input.get(), file.string(), 4, 255);
}

Result<Image8> read_image8(std::span<const std::uint8_t> bytes, const std::string& name) {
  const bool is_png = bytes.size() > 4 && bytes[1] == 'P' && bytes[2] == 'N' && bytes[3] == 'G';
  const std::string file_name = is_png ? "memory.png" : "memory.jpg";
  OIIO::Filesystem::IOMemReader reader(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
  OIIO::Filesystem::IOProxy* proxy = &reader;
  OIIO::ImageSpec configuration = plain_colours();
  configuration.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, static_cast<void*>(&proxy));
  auto input = open_picture(file_name, &configuration, proxy);
  if (!input) return cannot_open(name);
  return read<std::uint8_t>(input.get(), name, 4, 255);
}

Result<ImageF> read_image_float(const fs::path& file) {
  auto input = open_picture(file.string());
  if (!input) return cannot_open(file.string());
  const bool is_srgb = input->spec().format.basesize() == 1;
  Result<ImageF> image = read<float>(input.get(), file.string(), 3, 1.0f);
  if (image && is_srgb)
    for (float& value : image->pixels) value = linear_from_srgb(value);
  return image;
}

Status write_image(const fs::path& file, const Image8& image) {
  return write(file, image, OIIO::TypeDesc::UINT8);
}

Status write_image(const fs::path& file, const ImageF& image) {
  return write(file, image, OIIO::TypeDesc::FLOAT);
}

}  // namespace parvis
