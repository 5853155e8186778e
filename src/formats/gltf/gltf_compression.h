// Compressed glTF 2.0: EXT_meshopt_compression and KHR_draco_mesh_compression, undone by their own libraries
// before anything else reads the file.
#pragma once

#include <vector>

#include "formats/gltf/gltf_file.h"

namespace parvis::scene {

/// Is this a buffer that only readers without EXT_meshopt_compression would need?
bool is_fallback_buffer(const GltfFile::Json& buffer);

/// Puts plain buffers, buffer views and accessors in place of the compressed ones of `file`, whose parts
/// `json` and `buffers` are. Throws GltfProblem, which names the view or the mesh, where the compressed bytes
/// are damaged or are not as many as claimed.
void decompress(const GltfFile& file, GltfFile::Json& json, std::vector<std::vector<std::uint8_t>>& buffers);

}  // namespace parvis::scene
