#include "scene/data/deformation.h"

namespace parvis::scene {
namespace {

void add(std::vector<glm::vec3>& values, const std::vector<glm::vec3>& more, float weight) {
  for (std::size_t v = 0; v < more.size(); ++v) values[v] += weight * more[v];
}

void morph(const Deformation& deformation, std::span<const float> weights, Mesh& mesh) {
  mesh.positions = deformation.positions;
  mesh.normals = deformation.normals;
  for (std::size_t i = 0; i < deformation.targets.size(); ++i) {
    if (weights[i] == 0.0f) continue;
    add(mesh.positions, deformation.targets[i].positions, weights[i]);
    add(mesh.normals, deformation.targets[i].normals, weights[i]);
  }
}

/// Linear blend skinning: each vertex moves by the weighted mean of its joints' motions.
void deform(const Skin& skin, const std::vector<glm::mat4>& model_from_node, int node, Mesh& mesh) {
  const glm::mat4 node_from_model = glm::inverse(model_from_node[std::size_t(node)]);
  std::vector<glm::mat4> node_from_mesh(skin.joints.size());
  for (std::size_t i = 0; i < skin.joints.size(); ++i)
    node_from_mesh[i] =
        node_from_model * model_from_node[std::size_t(skin.joints[i])] * skin.joint_from_mesh[i];
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    glm::mat4 matrix(0.0f);
    for (int k = 0; k < 4; ++k)
      if (skin.weights[v][k] != 0.0f)
        matrix += skin.weights[v][k] * node_from_mesh[skin.joints_of_vertex[v][k]];
    mesh.positions[v] = glm::vec3(matrix * glm::vec4(mesh.positions[v], 1.0f));
    mesh.normals[v] = glm::mat3(matrix) * mesh.normals[v];
  }
}

}  // namespace

void deform(const Deformation& deformation, std::span<const float> weights,
            const std::vector<glm::mat4>& model_from_node, int node, Mesh& mesh) {
  morph(deformation, weights, mesh);
  if (!deformation.skin.joints.empty()) deform(deformation.skin, model_from_node, node, mesh);
  for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
    const float length = glm::length(mesh.normals[v]);
    mesh.normals[v] = length > 0.0f ? mesh.normals[v] / length : deformation.normals[v];
  }
}

}  // namespace parvis::scene
