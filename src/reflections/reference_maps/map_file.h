// A reference map in a file of its own, so that baking can be interrupted between two maps and go on.
//
//   8 bytes  "PARVISM1"
//   u64      key: what the map depends on (map_cache.h)
//   u32      maps in all, and for each of them: 3 f32, its place, metres in the world
//   u32      number of this map, from 0
//   u32      texels per side of its layer
//   u32      textures, and for each of them: u32 size in bytes, then as many bytes as OpenGL gives and takes
//   u64      checksum of all before it (base/content_hash.h)
//
// Numbers are little-endian.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "base/result.h"

namespace parvis::reference_maps {

struct MapFile {
  std::uint64_t key = 0;
  std::vector<glm::vec3> places;  ///< of all maps, so that one file knows where the others are
  std::uint32_t number = 0, resolution = 0;
  std::vector<std::vector<std::uint8_t>> textures;
};

/// The file appears whole or not at all.
Status write_map_file(const std::filesystem::path& file, const MapFile& map);

/// Errors say whether the file is missing, foreign, of another version, cut short or damaged.
Result<MapFile> read_map_file(const std::filesystem::path& file);

}  // namespace parvis::reference_maps
