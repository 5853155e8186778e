#include "environment_maps/map_file.h"

#include <algorithm>
#include <cstring>

#include "base/content_hash.h"
#include "base/files.h"

namespace parvis::environment_maps {
namespace {

constexpr std::string_view family = "PARVISM", magic = "PARVISM1";
constexpr std::uint32_t most_textures = 16, most_places = 10000;

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::uint64_t checksum(std::string_view bytes) {
  ContentHash hash;
  hash.add_text(bytes);
  return hash.value();
}

/// Takes values off the front of bytes; what lies beyond their end is zero, and noted.
class Taker {
 public:
  explicit Taker(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  T take() {
    T value{};
    const std::string_view part = take(sizeof value);
    std::ranges::copy(part, reinterpret_cast<char*>(&value));
    return value;
  }
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) {
      ended_early_ = true;
      return {};
    }
    const std::string_view part = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return part;
  }
  bool is_at_end() const { return bytes_.empty() && !ended_early_; }

 private:
  std::string_view bytes_;
  bool ended_early_ = false;
};

}  // namespace

Status write_map_file(const std::filesystem::path& file, const MapFile& map) {
  std::string bytes(magic);
  append(bytes, map.key);
  append(bytes, std::uint32_t(map.places.size()));
  for (const glm::vec3& place : map.places) append(bytes, place);
  append(bytes, map.number);
  append(bytes, map.resolution);
  append(bytes, std::uint32_t(map.textures.size()));
  for (const std::vector<std::uint8_t>& texture : map.textures) {
    append(bytes, std::uint32_t(texture.size()));
    bytes.append(reinterpret_cast<const char*>(texture.data()), texture.size());
  }
  append(bytes, checksum(bytes));
  return write_file(file, bytes);
}

Result<MapFile> read_map_file(const std::filesystem::path& file) {
  const Result<std::string> bytes = read_file(file);
  if (!bytes) return bytes.errors();
  if (!bytes->starts_with(family)) return error("{}: is no reference map of Parvis", file.string());
  if (!bytes->starts_with(magic))
    return error("{}: is a reference map of another version of Parvis ({}; this one reads {})", file.string(),
                 bytes->substr(0, magic.size()), magic);
  const Error cut = error("{}: is cut short or damaged", file.string());
  if (bytes->size() < magic.size() + sizeof(std::uint64_t)) return cut;
  std::string_view content(*bytes);
  std::uint64_t sum = 0;
  std::memcpy(&sum, content.data() + content.size() - sizeof sum, sizeof sum);
  content.remove_suffix(sizeof sum);
  if (checksum(content) != sum) return cut;

  Taker taker(content.substr(magic.size()));
  MapFile map;
  map.key = taker.take<std::uint64_t>();
  const std::uint32_t places = taker.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < std::min(places, most_places); ++i)
    map.places.push_back(taker.take<glm::vec3>());
  map.number = taker.take<std::uint32_t>();
  map.resolution = taker.take<std::uint32_t>();
  const std::uint32_t textures = taker.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < std::min(textures, most_textures); ++i) {
    const std::string_view texture = taker.take(taker.take<std::uint32_t>());
    map.textures.emplace_back(texture.begin(), texture.end());
  }
  if (!taker.is_at_end()) return cut;
  return map;
}

}  // namespace parvis::environment_maps
