// Meshes of models as glTF 2.0 (sections 3.7.2 and 3.7.3), with their morph targets and what skins need.
#pragma once

#include <vector>

#include "base/result.h"
#include "formats/gltf/gltf_chunk.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// A mesh of the file, and where each object of its model hangs it.
struct WrittenMesh {
  int mesh = 0;                              ///< in the file
  int node = 0;                              ///< of the model
  const Deformation* deformation = nullptr;  ///< of its parts; null: they are rigid
  int inverse_bind = no_index;               ///< accessor, where it has a skin
};

/// Appends the parts of `model` to the list `meshes` of the file: those that hang on one node and deform
/// alike are one mesh. `model` must outlive the result. More joints than glTF can number are an error.
Result<std::vector<WrittenMesh>> write_meshes(const Model& model, int first_material, GltfChunk& chunk,
                                              GltfChunk::Json& meshes);

}  // namespace parvis::scene
