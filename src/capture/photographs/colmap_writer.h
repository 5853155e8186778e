// Path-traced pictures with known cameras as a COLMAP model. The world stays
// as it is: metres, z up.
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"
#include "scene/data/taken_picture.h"

namespace parvis::photographs {

/// Writes cameras.txt, images.txt, points3D.txt into `folder`. Pictures of one size and field of view share a
/// COLMAP camera.
Status write_colmap(const std::filesystem::path& folder, const std::vector<scene::TakenPicture>& pictures,
                    const std::vector<scene::SeenPoint>& points);

}  // namespace parvis::photographs
