// Meshes that deform while their model moves: morph targets and skins (glTF 2.0, sections 3.7.2.2 and 3.7.3).
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/mesh.h"

namespace parvis::scene {

/// The vectors that a weight of 1 adds to each vertex. Either list may be empty: nothing.
struct MorphTarget {
  std::vector<glm::vec3> positions, normals;
};

/// Which joints pull at each vertex, and how much. Without joints: none do.
struct Skin {
  std::vector<int> joints;                   ///< nodes of the model
  std::vector<glm::mat4> joint_from_mesh;    ///< of each joint: the inverse bind matrices
  std::vector<glm::uvec4> joints_of_vertex;  ///< into `joints`
  std::vector<glm::vec4> weights;            ///< of these; each sums to 1
};

/// How a part's mesh follows its model's pose. Lists of vertices are as long as the part's.
struct Deformation {
  std::vector<glm::vec3> positions, normals;  ///< before anything deforms them
  std::vector<MorphTarget> targets;
  std::vector<float> weights;  ///< of the targets, at rest
  int weights_node = -1;       ///< the node whose animated weights are taken
  Skin skin;
};

/// Writes positions and normals of `mesh`, in the frame of the node `node`: targets first, then joints.
void deform(const Deformation& deformation, std::span<const float> weights,
            const std::vector<glm::mat4>& model_from_node, int node, Mesh& mesh);

}  // namespace parvis::scene
