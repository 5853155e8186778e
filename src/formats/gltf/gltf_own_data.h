// Data that other programs do not know, as an extension of a whole glTF file: an object of JSON, and views of
// the binary chunk that it names. Programs that know no such extension show the rest of the file.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::scene {

struct GltfOwnData {
  std::string extension;                                   ///< "PARVIS_..."
  std::string json;                                        ///< text of an object; "views" in it is taken
  std::vector<std::pair<std::string, std::string>> views;  ///< name and bytes, in the order of their names
};

/// Writes a model as write_gltf does (gltf_writer.h), with the extension beside "scenes": the JSON, and in
/// "views" the number of the buffer view of each name. Not in "extensionsRequired". Errors: JSON that is no
/// object.
Status write_gltf(const std::filesystem::path& file, const Model& model, const GltfOwnData& own);

/// The extension of a .gltf or .glb. Errors: no such file, no glTF, without the extension, or with views that
/// are not there.
Result<GltfOwnData> read_gltf_own_data(const std::filesystem::path& file, const std::string& extension);

}  // namespace parvis::scene
