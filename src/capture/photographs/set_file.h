// A photograph set as a folder on disk: a COLMAP model (binary), which every tool reads, and photographs.json
// beside it with what COLMAP has no place for: where the pictures are, gains, masks, how the frame was
// turned.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "capture/photographs/colmap_set.h"

namespace parvis::photographs {

/// Entries of photographs.json about a photograph that somebody wrote by hand.
struct MaskAndGain {
  std::filesystem::path mask;  ///< empty: none
  glm::dvec3 gain{1.0};
};
/// Masks and gains by the photographs' names.
using MasksAndGains = std::map<std::string, MaskAndGain>;

/// Writes cameras.bin, images.bin, points3D.bin and photographs.json into `folder`. Paths are kept relative
/// to it. `of_others`: kept in photographs.json for photographs that have no camera in this set.
Status write_photograph_set(const std::filesystem::path& folder, const PhotographSet& set,
                            const std::filesystem::path& picture_folder, const MasksAndGains& of_others = {});

/// The masks and gains of photographs.json alone, for who writes that file again; none where there is no
/// such file. Errors, with file and line: whatever of it cannot be read, so that it would be lost.
Result<MasksAndGains> read_masks_and_gains(const std::filesystem::path& folder);

/// Reads what `write_photograph_set` wrote. Photographs whose files are missing or of another size are left
/// out and named in the problems.
Result<LoadedSet> read_photograph_set(const std::filesystem::path& folder);

}  // namespace parvis::photographs
