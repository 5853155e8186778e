#include "formats/readers/zip_member.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>

namespace parvis::formats {
namespace {

constexpr std::string_view directory_end_mark{"PK\5\6", 4}, directory_mark{"PK\1\2", 4},
    file_mark{"PK\3\4", 4};
constexpr std::size_t directory_end_bytes = 22, directory_bytes = 46, file_bytes = 30;
constexpr std::uint32_t stored = 0, deflated = 8;

/// Numbers of an archive, little endian; 0 beyond its end.
std::uint32_t number(std::string_view archive, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  if (at > archive.size() || archive.size() - at < size) return 0;
  for (std::size_t i = size; i-- > 0;) value = value << 8 | std::uint8_t(archive[at + i]);
  return value;
}

std::string inflated(std::string_view packed, std::size_t count) {
  constexpr int largest_window_without_header = -15;
  std::string front(count, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, largest_window_without_header) != Z_OK) return {};
  // zlib only reads what it calls not constant.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = uInt(std::min<std::size_t>(packed.size(), std::size_t{1} << 30));
  stream.next_out = reinterpret_cast<Bytef*>(front.data());
  stream.avail_out = uInt(front.size());
  inflate(&stream, Z_SYNC_FLUSH);
  front.erase(front.size() - stream.avail_out);
  inflateEnd(&stream);
  return front;
}

}  // namespace

std::optional<std::string> zip_member_front(std::string_view archive, std::string_view name_end,
                                            std::size_t count) {
  const std::size_t end = archive.rfind(directory_end_mark);
  if (end == std::string_view::npos || archive.size() - end < directory_end_bytes) return std::nullopt;
  std::size_t at = number(archive, end + 16, 4);
  for (std::uint32_t left = number(archive, end + 10, 2); left > 0; --left) {
    if (at > archive.size() || !archive.substr(at).starts_with(directory_mark)) return std::nullopt;
    const std::uint32_t method = number(archive, at + 10, 2), size = number(archive, at + 20, 4),
                        name_bytes = number(archive, at + 28, 2);
    const std::size_t local = number(archive, at + 42, 4), name_at = at + directory_bytes;
    if (name_at > archive.size()) return std::nullopt;
    const std::string_view name = archive.substr(name_at, name_bytes);
    at = name_at + name_bytes + number(archive, at + 30, 2) + number(archive, at + 32, 2);
    if (!name.ends_with(name_end)) continue;
    const std::size_t data =
        local + file_bytes + number(archive, local + 26, 2) + number(archive, local + 28, 2);
    if (data > archive.size() || !archive.substr(local).starts_with(file_mark)) return std::nullopt;
    const std::string_view packed = archive.substr(data, size);
    if (method == stored) return std::string(packed.substr(0, count));
    if (method == deflated) return inflated(packed, count);
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace parvis::formats
