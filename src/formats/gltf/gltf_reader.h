// glTF 2.0 (.gltf, .glb) to a Model: meshes, nodes, materials with KHR_texture_transform, _clearcoat,
// _emissive_strength and _transmission, EXT_meshopt_compression, KHR_draco_mesh_compression, animations,
// skins and morph targets (these parts stand as they do at rest, and know how they deform).
#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// Metres, turned from y up to z up by node 0. A picture that is missing or damaged is named in `warnings`
/// and replaced by a visible checker. Everything else that is wrong is an error.
Result<Model> read_gltf(const std::filesystem::path& file, Errors& warnings);

/// The bytes of an extension of the file that names their buffer view: {"bufferView": n}. Errors: the file
/// has no such extension; as read_gltf.
Result<std::string> gltf_attachment(const std::filesystem::path& file, const std::string& extension);

}  // namespace parvis::scene
