// An arcaded square in the spirit of Place Garibaldi in Nice: ochre facades in relief over arcades, a statue
// in a fountain, paving, streets that lead out, a tram line and traffic.
#pragma once

#include <cstdint>
#include <filesystem>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::square {

/// Houses and ground, with their materials.
scene::Model make_square(std::uint64_t seed);

/// Writes the scripts `place.xp` (static geometry), `life.xp` (the rest), `square.xp` (all of it) and
/// `photographs.xp` (cameras to capture it from), models, textures, the sky and a coarse model into `folder`,
/// each file complete or not at all. Errors: what cannot be written.
Status write_square(const std::filesystem::path& folder, std::uint64_t seed);

}  // namespace parvis::square
