// A packed facade as a glTF file: surfaces with one baked texture, which any program shows, and all that the
// layers hold in the extension PARVIS_layered_photographs (docs/facades.md), from which Parvis reads the
// facade again as it was.
#pragma once

#include <filesystem>

#include "capture/facades/packed_facade.h"

namespace parvis::facades {

/// Writes `file` (.glb) and its picture beside it. `max_side`: see baked_texture.
Status write_facade_gltf(const std::filesystem::path& file, const PackedFacade& facade, int max_side = 4096);

/// Reads the extension. Errors: no glTF, without the extension, damaged, or with numbers that do not fit
/// together.
Result<PackedFacade> read_facade_gltf(const std::filesystem::path& file);

}  // namespace parvis::facades
