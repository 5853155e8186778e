// Cameras as a glTF 2.0 file of their own, which Blender and other viewers open.
#pragma once

#include "scene/colmap_writer.h"

namespace parvis::scene {

/// Writes `file` (.gltf): one node and one perspective camera a picture, named after it, under a node that
/// turns z up to y up.
Status write_gltf_cameras(const std::filesystem::path& file, const std::vector<TakenPicture>& pictures);

}  // namespace parvis::scene
