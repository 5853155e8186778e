// A kitchen for curved mirrors, after the scene of Estalella and others 2005 (figures 6 to 8): tiles,
// cupboards, fruit, crockery; kettle, pans, spoons, a glass, and a mixing bowl with a mirroring inside.
#pragma once

#include <cstdint>
#include <filesystem>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::kitchen {

/// Everything that does not mirror, with its materials.
scene::Model make_kitchen(std::uint64_t seed);

/// Writes the scripts `kitchen.xp` and `glass.xp` (solid glass on the same worktop), models, textures and the
/// light into `folder`, as write_paper_city does.
Status write_kitchen(const std::filesystem::path& folder, std::uint64_t seed);

}  // namespace parvis::kitchen
