#include "scene/gltf_skin.h"

#include <cmath>

#include "scene/gltf_values.h"

namespace parvis::scene {
GltfSkin read_skin(const GltfFile& file, int skin) {
  const GltfFile::Json& source = file.list("skins")[std::size_t(skin)];
  GltfSkin result;
  result.name = source.value("name", fmt::format("skin {}", skin));
  const std::size_t nodes = file.list("nodes").size();
  for (const GltfFile::Json& joint : source.value("joints", GltfFile::Json::array())) {
    if (!joint.is_number_unsigned() || joint.get<std::size_t>() >= nodes)
      gltf_fail("skin \"{}\": joint {} is missing; there are {} nodes", result.name, joint.dump(), nodes);
    result.joints.push_back(joint.get<int>());
  }
  if (result.joints.empty()) gltf_fail("skin \"{}\" has no joints", result.name);
  result.joint_from_mesh.assign(result.joints.size(), glm::mat4(1.0f));
  const int accessor = file.index(source, "inverseBindMatrices", "accessors");
  if (accessor < 0) return result;
  const std::vector<float> values = file.floats(accessor, 16);
  if (values.size() < 16 * result.joints.size())
    gltf_fail("skin \"{}\" has {} joints and {} inverse bind matrices", result.name, result.joints.size(),
              values.size() / 16);
  for (std::size_t i = 0; i < 16 * result.joints.size(); ++i)
    result.joint_from_mesh[i / 16][int(i % 16 / 4)][int(i % 4)] = values[i];
  return result;
}

SkinWeights read_skin_weights(const GltfFile& file, const GltfFile::Json& attributes, const GltfSkin& skin,
                              std::size_t vertex_count) {
  const int joints = file.index(attributes, "JOINTS_0", "accessors"),
            weights = file.index(attributes, "WEIGHTS_0", "accessors");
  if (joints < 0 || weights < 0) gltf_fail("skin \"{}\" bends a mesh without joints or weights", skin.name);
  const std::vector<float> joint_values = file.floats(joints, 4), weight_values = file.floats(weights, 4);
  if (joint_values.size() != 4 * vertex_count || weight_values.size() != 4 * vertex_count)
    gltf_fail("skin \"{}\": {} joints and {} weights for {} vertices", skin.name, joint_values.size() / 4,
              weight_values.size() / 4, vertex_count);
  SkinWeights result{std::vector<glm::uvec4>(vertex_count), std::vector<glm::vec4>(vertex_count)};
  for (std::size_t i = 0; i < joint_values.size(); ++i) {
    if (!(joint_values[i] >= 0.0f && joint_values[i] < float(skin.joints.size())))
      gltf_fail("skin \"{}\": vertex {} hangs on joint {}; there are {}", skin.name, i / 4, joint_values[i],
                skin.joints.size());
    result.joints[i / 4][int(i % 4)] = std::uint32_t(joint_values[i]);
    result.weights[i / 4][int(i % 4)] = weight_values[i];
  }
  for (glm::vec4& weight : result.weights) {
    const float sum = weight.x + weight.y + weight.z + weight.w;
    if (!std::isfinite(sum)) gltf_fail("skin \"{}\" has a weight that is not finite", skin.name);
    weight = sum > 0.0f ? weight / sum : glm::vec4(1, 0, 0, 0);
  }
  return result;
}

void bend(Mesh& mesh, const SkinWeights& weights, const std::vector<glm::mat4>& target_from_mesh) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    glm::mat4 matrix(0.0f);
    for (int k = 0; k < 4; ++k) matrix += weights.weights[v][k] * target_from_mesh[weights.joints[v][k]];
    mesh.positions[v] = glm::vec3(matrix * glm::vec4(mesh.positions[v], 1.0f));
    const glm::vec3 normal = glm::mat3(matrix) * mesh.normals[v];
    if (glm::length(normal) > 0.0f) mesh.normals[v] = glm::normalize(normal);
  }
}

}  // namespace parvis::scene
