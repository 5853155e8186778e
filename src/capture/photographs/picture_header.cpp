#include "capture/photographs/picture_header.h"

#include <filesystem>
#include <optional>

#include "base/file_front.h"
#include "base/image_io.h"

namespace parvis::photographs {
namespace {

constexpr unsigned char end_of_image = 0xd9, start_of_scan = 0xda, application_1 = 0xe1;
constexpr std::size_t header_bytes = std::size_t(1)
                                     << 20;  // EXIF with its thumbnail, profiles, then the size

bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8"); }
bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); }

unsigned char byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

/// Markers without a segment: restarts and a filler.
bool stands_alone(unsigned char marker) {
  return (marker >= 0xd0 && marker <= 0xd7) || marker == 0x01 || marker == 0xff;
}

/// The place behind the entropy-coded data that begins at `at`: the next marker that is no stuffed zero and
/// no restart.
std::size_t after_scan(std::string_view bytes, std::size_t at) {
  for (at = bytes.find('\xff', at); at != std::string_view::npos && at + 1 < bytes.size();
       at = bytes.find('\xff', at + 1))
    if (const unsigned char marker = byte_at(bytes, at + 1); marker != 0 && !stands_alone(marker)) return at;
  return bytes.size();
}

bool is_frame_start(unsigned char marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

/// Numbers of a TIFF structure, in either byte order. Reading outside of it gives 0.
class Tiff {
 public:
  explicit Tiff(std::string_view bytes) : bytes_(bytes), is_big_endian_(bytes.starts_with("MM")) {}

  std::uint32_t number(std::size_t at, std::size_t size) const {
    std::uint32_t value = 0;
    if (size > 4 || at > bytes_.size() || bytes_.size() - at < size) return 0;
    for (std::size_t i = 0; i < size; ++i)
      value = value << 8 | byte_at(bytes_, at + (is_big_endian_ ? i : size - 1 - i));
    return value;
  }
  /// The entry of `tag` in the directory at `directory`: a SHORT or LONG, or the first RATIONAL. 0 where
  /// there is none.
  double value(std::size_t directory, std::uint32_t tag) const {
    const std::size_t count = number(directory, 2);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t entry = directory + 2 + 12 * i;
      if (number(entry, 2) != tag) continue;
      const std::uint32_t type = number(entry + 2, 2);
      if (type == 3) return number(entry + 8, 2);
      if (type == 4) return number(entry + 8, 4);
      const std::size_t at = number(entry + 8, 4);
      const std::uint32_t below = number(at + 4, 4);
      return type == 5 && below > 0 ? double(number(at, 4)) / below : 0.0;
    }
    return 0.0;
  }
  /// The ASCII text of `tag`, without the zero at its end; empty where there is none.
  std::string text(std::size_t directory, std::uint32_t tag) const {
    const std::size_t count = number(directory, 2);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t entry = directory + 2 + 12 * i;
      if (number(entry, 2) != tag || number(entry + 2, 2) != 2) continue;
      const std::size_t length = number(entry + 4, 4);
      const std::size_t at = length > 4 ? number(entry + 8, 4) : entry + 8;
      if (at >= bytes_.size()) return "";
      const std::string_view held = bytes_.substr(at, length);
      return std::string(held.substr(0, held.find('\0')));
    }
    return "";
  }

 private:
  std::string_view bytes_;
  bool is_big_endian_;
};

void read_exif(std::string_view segment, PictureHeader& header) {
  constexpr std::string_view mark("Exif\0\0", 6);
  if (!segment.starts_with(mark)) return;
  const Tiff tiff(segment.substr(mark.size()));
  const std::size_t directory = tiff.number(4, 4);
  const double orientation = tiff.value(directory, 0x0112);
  if (orientation >= 1.0 && orientation <= 8.0) header.orientation = int(orientation);
  header.camera = tiff.text(directory, 0x0110);
  const std::size_t camera = std::size_t(tiff.value(directory, 0x8769));
  if (camera == 0) return;
  header.focal_length_mm = tiff.value(camera, 0x920a);
  header.focal_length_35mm_mm = tiff.value(camera, 0xa405);
  header.taken = tiff.text(camera, 0x9003);
}

/// Nothing where the bytes end before the frame's size.
std::optional<PictureHeader> jpeg_header(std::string_view bytes) {
  PictureHeader header;
  const auto two = [&](std::size_t at) { return int(byte_at(bytes, at)) << 8 | int(byte_at(bytes, at + 1)); };
  for (std::size_t at = 2; at + 9 < bytes.size() && byte_at(bytes, at) == 0xff;) {
    const unsigned char marker = byte_at(bytes, at + 1);
    if (stands_alone(marker)) {
      at += marker == 0xff ? 1 : 2;
      continue;
    }
    if (is_frame_start(marker)) {
      header.height = two(at + 5);
      header.width = two(at + 7);
      return header;
    }
    const std::size_t length = std::size_t(two(at + 2));
    if (marker == application_1 && length > 2) read_exif(bytes.substr(at + 4, length - 2), header);
    at += 2 + length;
  }
  return std::nullopt;
}

std::optional<PictureHeader> png_header(std::string_view bytes) {
  if (bytes.size() < 24) return std::nullopt;
  const auto four = [&](std::size_t at) {
    return int(byte_at(bytes, at)) << 24 | int(byte_at(bytes, at + 1)) << 16 |
           int(byte_at(bytes, at + 2)) << 8 | int(byte_at(bytes, at + 3));
  };
  PictureHeader header;
  header.width = byte_at(bytes, 16) < 0x80 ? four(16) : 0;
  header.height = byte_at(bytes, 20) < 0x80 ? four(20) : 0;
  return header;
}

}  // namespace

Result<PictureHeader> parse_picture_header(std::string_view bytes, const std::string& name) {
  if (!is_jpeg(bytes) && !is_png(bytes)) return error("{}: is neither JPEG nor PNG", name);
  const std::optional<PictureHeader> header = is_jpeg(bytes) ? jpeg_header(bytes) : png_header(bytes);
  if (!header || header->width < 1 || header->height < 1)
    return error("{}: the picture is damaged or cut short: its size is missing", name);
  return *header;
}

Result<PictureHeader> read_picture_header(const std::filesystem::path& file) {
  const Result<std::string> bytes = read_front(file, header_bytes);
  if (!bytes) return bytes.errors();
  if (is_jpeg(*bytes) || is_png(*bytes)) return parse_picture_header(*bytes, file.string());
  const Result<std::string> jpeg = jpeg_of(file);
  if (!jpeg) return jpeg.errors();
  return parse_picture_header(*jpeg, file.string());
}

bool is_whole_jpeg(std::string_view bytes) {
  if (!bytes.starts_with("\xff\xd8")) return true;
  std::size_t at = 2;
  while (at + 1 < bytes.size() && byte_at(bytes, at) == 0xff) {
    const unsigned char marker = byte_at(bytes, at + 1);
    if (marker == end_of_image) return true;
    if (stands_alone(marker)) {
      at += marker == 0xff ? 1 : 2;
      continue;
    }
    if (at + 3 >= bytes.size()) return false;
    at += 2 + (std::size_t(byte_at(bytes, at + 2)) << 8 | byte_at(bytes, at + 3));
    if (marker == start_of_scan) at = after_scan(bytes, at);
  }
  return false;
}

}  // namespace parvis::photographs
