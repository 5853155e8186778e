// Skins of glTF 2.0 (section 3.7.3.3): meshes that joints bend.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/mesh.h"
#include "scene/gltf_file.h"

namespace parvis::scene {

struct GltfSkin {
  std::string name;
  std::vector<int> joints;                 ///< nodes of the file
  std::vector<glm::mat4> joint_from_mesh;  ///< of each joint: the inverse bind matrices
};

/// Throws GltfProblem, which names the skin, where joints are missing or not in the file, or where there are
/// fewer matrices than joints.
GltfSkin read_skin(const GltfFile& file, int skin);

/// Which joints pull at each vertex, and how much.
struct SkinWeights {
  std::vector<glm::uvec4> joints;  ///< into GltfSkin::joints
  std::vector<glm::vec4> weights;  ///< each sums to 1
};

/// Of a primitive; throws GltfProblem where a vertex names a joint that the skin lacks.
SkinWeights read_skin_weights(const GltfFile& file, const GltfFile::Json& attributes, const GltfSkin& skin,
                              std::size_t vertex_count);

/// Moves each vertex by the weighted mean of `target_from_mesh`, one matrix a joint.
void bend(Mesh& mesh, const SkinWeights& weights, const std::vector<glm::mat4>& target_from_mesh);

}  // namespace parvis::scene
