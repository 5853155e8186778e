// Cameras as glTF 2.0 (section 3.10), which Blender and other viewers open: in a scene, or as a file of their
// own.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/result.h"
#include "scene/data/taken_picture.h"

namespace parvis::scene {

/// A perspective camera, for the list of cameras of a file.
nlohmann::json gltf_camera(const std::string& name, const Camera& camera);
/// The node that places the camera of this index, below a node that turns z up to y up.
nlohmann::json gltf_camera_node(const std::string& name, const Camera& camera, std::size_t index);

/// Writes `file` (.gltf): one node and one perspective camera a picture, named after it, under a node that
/// turns z up to y up.
Status write_gltf_cameras(const std::filesystem::path& file, const std::vector<TakenPicture>& pictures);

}  // namespace parvis::scene
