#include "reflections/reference_maps/map_file.h"

#include <algorithm>

#include "base/sealed_file.h"

namespace parvis::reference_maps {
namespace {

constexpr std::uint32_t max_textures = 16;

}  // namespace

std::string bytes_of(const MapFile& map) {
  std::string bytes;
  append_values(bytes, map.places);
  append_value(bytes, map.number);
  append_value(bytes, map.resolution);
  append_value(bytes, std::uint32_t(map.textures.size()));
  for (const std::vector<std::uint8_t>& texture : map.textures) append_values(bytes, texture);
  return bytes;
}

std::optional<MapFile> map_of(std::string_view bytes) {
  ByteReader reader(bytes);
  MapFile map;
  map.places = reader.take_values<glm::vec3>();
  map.number = reader.take<std::uint32_t>();
  map.resolution = reader.take<std::uint32_t>();
  const std::uint32_t textures = reader.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < std::min(textures, max_textures); ++i)
    map.textures.push_back(reader.take_values<std::uint8_t>());
  if (!reader.is_at_end()) return std::nullopt;
  return map;
}

}  // namespace parvis::reference_maps
