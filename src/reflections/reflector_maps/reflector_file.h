// A reflector with its maps in a file: see base/sealed_file.h. All its parts follow one another as Reflector
// has them; lists begin with their length.
#pragma once

#include <filesystem>

#include "reflections/reflector_maps/reflector_map.h"

namespace parvis::reflector_maps {

Status write_reflector_file(const std::filesystem::path& file, const Reflector& reflector);

/// Errors say whether the file is missing, foreign, of another version, cut short or damaged.
Result<Reflector> read_reflector_file(const std::filesystem::path& file);

}  // namespace parvis::reflector_maps
