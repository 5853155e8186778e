// Compressed glTF 2.0: EXT_meshopt_compression, KHR_meshopt_compression and KHR_draco_mesh_compression,
// undone before anything else reads the file.
#pragma once

#include <vector>

#include "formats/gltf/gltf_file.h"

namespace parvis::scene {

/// Flags of the file's buffers: 0 where only readers without its compressions would need it, else 1. Such a
/// buffer may be missing.
std::vector<char> needed_buffers(const GltfFile& file);

/// Puts plain buffers, buffer views and accessors in place of the compressed ones of `file`, whose parts
/// `json` and `buffers` are. Throws GltfProblem, which names the view or the mesh, where the compressed bytes
/// are damaged or are not as many as claimed.
void decompress(const GltfFile& file, GltfFile::Json& json, std::vector<std::vector<std::uint8_t>>& buffers);

}  // namespace parvis::scene
