// A reflector with its maps in a file: see base/sealed_file.h. All its parts follow one another as Reflector
// has them; lists begin with their length.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "reflections/reflector_maps/reflector_map.h"

namespace parvis::reflector_maps {

/// The content of the file for `write_reflector_content`: reflectors may be made in another process than the
/// one that writes them. `key` is a hash of what the reflector was made of; it is sealed with it.
std::string reflector_content(std::uint64_t key, const Reflector& reflector);
/// Writes it; the file appears completely or not at all.
Status write_reflector_content(const std::filesystem::path& file, std::string_view content);

/// Errors say whether the file is missing, foreign, of another version, cut short or damaged, of another key,
/// or holds indices and counts that lie: anybody can make a right checksum.
Result<Reflector> read_reflector_file(const std::filesystem::path& file, std::uint64_t key);

}  // namespace parvis::reflector_maps
