// Photographs with known cameras as a COLMAP text model (cameras.txt, images.txt, points3D.txt):
// https://colmap.github.io/format.html. The world stays as it is: metres, z up.
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"
#include "scene/data/taken_picture.h"

namespace parvis::scene {

/// Writes the three files into `folder`. Pictures of one size and field of view share a COLMAP camera.
Status write_colmap(const std::filesystem::path& folder, const std::vector<TakenPicture>& pictures,
                    const std::vector<SeenPoint>& points);

}  // namespace parvis::scene
