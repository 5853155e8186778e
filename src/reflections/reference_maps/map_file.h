// A reference map as bytes, which a file of the cache holds (map_cache.h):
//
//   u32      maps in all, and for each of them: 3 f32, its place, metres in the world
//   u32      number of this map, from 0
//   u32      texels per side of its layer
//   u32      textures, and for each of them: u32 size in bytes, then as many bytes as OpenGL gives and takes
//
// Numbers are little-endian.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace parvis::reference_maps {

struct MapFile {
  std::vector<glm::vec3> places;  ///< of all maps, so that one file knows where the others are
  std::uint32_t number = 0, resolution = 0;
  std::vector<std::vector<std::uint8_t>> textures;
};

/// The bytes of a map.
std::string bytes_of(const MapFile& map);
/// The map of such bytes; none where they end early or hold more.
std::optional<MapFile> map_of(std::string_view bytes);

}  // namespace parvis::reference_maps
