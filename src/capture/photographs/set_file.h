// A photograph set as a folder on disk: a COLMAP model (binary), which every tool reads, and photographs.json
// beside it with what COLMAP has no place for: where the pictures are, gains, masks, how the frame was
// turned.
#pragma once

#include <filesystem>

#include "capture/photographs/colmap_set.h"

namespace parvis::photographs {

/// Writes cameras.bin, images.bin, points3D.bin and photographs.json into `folder`. Paths are kept relative
/// to it.
Status write_photograph_set(const std::filesystem::path& folder, const PhotographSet& set,
                            const std::filesystem::path& picture_folder);

/// Reads what `write_photograph_set` wrote. Photographs whose files are missing or of another size are left
/// out and named in the problems.
Result<LoadedSet> read_photograph_set(const std::filesystem::path& folder);

}  // namespace parvis::photographs
