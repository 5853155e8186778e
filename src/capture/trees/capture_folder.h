// A capture on disk: RGBA photographs and their cameras as a COLMAP model.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "base/result.h"
#include "capture/trees/tree_view.h"

namespace parvis::trees {

/// Writes NAME.png of each view and the model (cameras.txt, images.txt, points3D.txt) into a folder, which is
/// made.
Status write_capture(const std::filesystem::path& folder, std::span<const TreeView> views);

/// Writes the model alone, for pictures NAME.png that lie in the folder.
Status write_cameras(const std::filesystem::path& folder, std::span<const TreeView> views);

/// Reads the views of a folder, ordered by name, freed from their lenses' distortion. All that is wrong is
/// reported at once, by photograph: a missing picture, a size other than the camera's, a matte that is all 0
/// or all 255.
Result<std::vector<TreeView>> read_capture(const std::filesystem::path& folder);

}  // namespace parvis::trees
