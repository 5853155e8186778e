#include "reflections/reference_maps/map_file.h"

#include <algorithm>

#include "base/sealed_file.h"

namespace parvis::reference_maps {
namespace {

constexpr SealedKind kind{"PARVISM1", "reference map"};
constexpr std::uint32_t max_textures = 16;

}  // namespace

Status write_map_file(const std::filesystem::path& file, const MapFile& map) {
  std::string bytes;
  append_value(bytes, map.key);
  append_values(bytes, map.places);
  append_value(bytes, map.number);
  append_value(bytes, map.resolution);
  append_value(bytes, std::uint32_t(map.textures.size()));
  for (const std::vector<std::uint8_t>& texture : map.textures) append_values(bytes, texture);
  return write_sealed(file, kind, bytes);
}

Result<MapFile> read_map_file(const std::filesystem::path& file) {
  const Result<std::string> content = read_sealed(file, kind);
  if (!content) return content.errors();
  Taker taker(*content);
  MapFile map;
  map.key = taker.take<std::uint64_t>();
  map.places = taker.take_values<glm::vec3>();
  map.number = taker.take<std::uint32_t>();
  map.resolution = taker.take<std::uint32_t>();
  const std::uint32_t textures = taker.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < std::min(textures, max_textures); ++i)
    map.textures.push_back(taker.take_values<std::uint8_t>());
  if (!taker.is_at_end()) return cut_short(file);
  return map;
}

}  // namespace parvis::reference_maps
