// Animations of models as glTF 2.0 (section 3.11).
#pragma once

#include <vector>

#include "formats/gltf/gltf_chunk.h"
#include "formats/gltf/gltf_mesh_writer.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// Keyframes in the file, and what of a model they move.
struct WrittenChannel {
  GltfChunk::Json sampler;
  const char* path = "translation";
  int node = 0;             ///< of the model; of "weights" the node whose meshes take them
  std::size_t targets = 0;  ///< how many weights a key has
};

struct WrittenAnimation {
  std::string name;
  std::vector<WrittenChannel> channels;
};

/// Writes the keyframes of all animations of `model`; objects that share it share them.
std::vector<WrittenAnimation> write_keyframes(const Model& model, GltfChunk& chunk);

/// An object of a model, as its nodes stand in the file.
struct WrittenObject {
  std::string name;
  int first_node = 0;             ///< the file's node of the model's node 0; the others follow
  std::vector<int> node_of_mesh;  ///< the file's node that each WrittenMesh hangs on
};

/// The animation as one object plays it.
GltfChunk::Json animation_json(const WrittenAnimation& animation, const WrittenObject& object,
                               const std::vector<WrittenMesh>& meshes);

}  // namespace parvis::scene
