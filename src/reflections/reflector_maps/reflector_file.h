// A reflector with its maps as bytes, which a file of the cache holds. All its parts follow one another as
// Reflector has them; lists begin with their length.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "reflections/reflector_maps/reflector_map.h"

namespace parvis::reflector_maps {

/// The bytes of a reflector. It may be made in another process than the one that stores it.
std::string bytes_of(const Reflector& reflector);
/// The reflector of such bytes. None where they end early, or hold indices and counts that lie: anybody can
/// make a right checksum.
std::optional<Reflector> reflector_of(std::string_view bytes);

}  // namespace parvis::reflector_maps
