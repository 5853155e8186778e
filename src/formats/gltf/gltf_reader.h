// glTF 2.0 (.gltf, .glb) to a Model: meshes, nodes, materials with KHR_texture_transform, _clearcoat,
// _emissive_strength and _transmission, EXT_texture_webp and _avif, EXT_mesh_gpu_instancing,
// KHR_node_visibility, EXT_ and KHR_meshopt_compression, KHR_draco_mesh_compression, vertex colours,
// animations, skins and morph targets (these parts stand as they do at rest, and know how they deform).
#pragma once

#include <filesystem>

#include "base/result.h"
#include "formats/readers/readers.h"

namespace parvis::scene {

/// Metres, turned from y up to z up by node 0, which also takes off the coordinates of a national grid
/// (Model::origin). A picture that is missing or damaged is named in `warnings` and replaced by a visible
/// checker. Everything else that is wrong is an error.
Result<formats::FileContent> read_gltf_content(const std::filesystem::path& file, Errors& warnings);
/// The model alone, without the account of its file.
Result<Model> read_gltf(const std::filesystem::path& file, Errors& warnings);

}  // namespace parvis::scene
