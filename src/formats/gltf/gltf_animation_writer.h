// Animations of models as glTF 2.0 (section 3.11).
#pragma once

#include <vector>

#include "formats/gltf/gltf_chunk.h"
#include "formats/gltf/gltf_mesh_writer.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// One animation channel: its keyframes in the file, and the node and property of the model that they
/// animate.
struct WrittenChannel {
  GltfChunk::Json sampler;
  const char* path = "translation";
  int node = 0;             ///< of the model; for "weights" the node whose meshes are morphed
  std::size_t targets = 0;  ///< number of morph weights per key
};

/// The keyframes of one animation of a model, shared by all objects of that model.
struct WrittenAnimation {
  std::string name;
  std::vector<WrittenChannel> channels;
};

/// Writes the keyframes of all animations of `model` into the chunk, once for all objects that share the
/// model.
std::vector<WrittenAnimation> write_keyframes(const Model& model, GltfChunk& chunk);

/// An object and the numbers of its nodes in the file.
struct WrittenObject {
  std::string name;
  int first_node = 0;             ///< file index of the model's node 0; the others follow in order
  std::vector<int> node_of_mesh;  ///< file index of the node that carries each WrittenMesh
};

/// The glTF animation of one object.
GltfChunk::Json animation_json(const WrittenAnimation& animation, const WrittenObject& object,
                               const std::vector<WrittenMesh>& meshes);

}  // namespace parvis::scene
