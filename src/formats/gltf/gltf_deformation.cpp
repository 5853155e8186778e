#include "formats/gltf/gltf_deformation.h"

#include <algorithm>
#include <cmath>

#include "formats/gltf/gltf_meshes.h"
#include "formats/gltf/gltf_values.h"

namespace parvis::scene {
namespace {

using Json = GltfFile::Json;

std::vector<int> read_joints(const GltfFile& file, const GltfNodes& nodes, const Json& source,
                             const std::string& name) {
  std::vector<int> joints;
  for (const Json& joint : source.value("joints", Json::array())) {
    if (!joint.is_number_unsigned() || joint.get<std::size_t>() >= nodes.of_gltf.size())
      gltf_fail("skin \"{}\": joint {} is missing; there are {} nodes", name, joint.dump(),
                file.list("nodes").size());
    joints.push_back(nodes.of_gltf[joint.get<std::size_t>()]);
    if (joints.back() == no_index)
      gltf_fail("skin \"{}\": joint {} is missing from the scene", name, joint.dump());
  }
  if (joints.empty()) gltf_fail("skin \"{}\" has no joints", name);
  return joints;
}

std::vector<glm::mat4> read_inverse_bind(const GltfFile& file, const Json& source, const std::string& name,
                                         std::size_t joint_count) {
  std::vector<glm::mat4> matrices(joint_count, glm::mat4(1.0f));
  const int accessor = file.index(source, "inverseBindMatrices", "accessors");
  if (accessor < 0) return matrices;
  const std::vector<float> values = file.floats(accessor, 16);
  if (values.size() < 16 * joint_count)
    gltf_fail("skin \"{}\" has {} joints and {} inverse bind matrices", name, joint_count,
              values.size() / 16);
  for (std::size_t i = 0; i < 16 * joint_count; ++i)
    matrices[i / 16][int(i % 16 / 4)][int(i % 4)] = values[i];
  return matrices;
}

void read_weights(const GltfFile& file, const Json& attributes, const std::string& name,
                  std::size_t vertex_count, Skin& skin) {
  const std::vector<glm::vec4> joints = gltf_attribute<4>(file, attributes, "JOINTS_0");
  skin.weights = gltf_attribute<4>(file, attributes, "WEIGHTS_0");
  if (joints.empty() || skin.weights.empty())
    gltf_fail("skin \"{}\" deforms a mesh without joints or weights", name);
  if (joints.size() != vertex_count || skin.weights.size() != vertex_count)
    gltf_fail("skin \"{}\": {} joints and {} weights for {} vertices", name, joints.size(),
              skin.weights.size(), vertex_count);
  skin.joints_of_vertex.resize(vertex_count);
  for (std::size_t v = 0; v < vertex_count; ++v)
    for (int k = 0; k < 4; ++k) {
      if (!(joints[v][k] >= 0.0f && joints[v][k] < float(skin.joints.size())))
        gltf_fail("skin \"{}\": vertex {} hangs on joint {}; there are {}", name, v, joints[v][k],
                  skin.joints.size());
      skin.joints_of_vertex[v][k] = std::uint32_t(joints[v][k]);
    }
  for (glm::vec4& weight : skin.weights) {
    const float sum = weight.x + weight.y + weight.z + weight.w;
    if (!std::isfinite(sum)) gltf_fail("skin \"{}\" has a weight that is not finite", name);
    weight = sum > 0.0f ? weight / sum : glm::vec4(1, 0, 0, 0);
  }
}

std::vector<MorphTarget> read_targets(const GltfFile& file, const Json& primitive,
                                      const std::string& mesh_name, std::size_t vertex_count) {
  std::vector<MorphTarget> targets;
  for (const Json& source : gltf_targets(primitive)) {
    MorphTarget& target = targets.emplace_back();
    target.positions = gltf_attribute<3>(file, source, "POSITION");
    target.normals = gltf_attribute<3>(file, source, "NORMAL");
    for (const std::vector<glm::vec3>* list : {&target.positions, &target.normals})
      if (!list->empty() && list->size() != vertex_count)
        gltf_fail("mesh \"{}\": morph target {} has {} vertices; the mesh has {}", mesh_name,
                  targets.size() - 1, list->size(), vertex_count);
  }
  return targets;
}

/// The node's, else the mesh's, else all 0.
std::vector<float> read_target_weights(const Json& node, const Json& mesh_source,
                                       const std::string& mesh_name, std::size_t target_count) {
  const Json& source = node.contains("weights") ? node : mesh_source;
  if (!source.contains("weights")) return std::vector<float>(target_count, 0.0f);
  const auto weights = source["weights"].get<std::vector<float>>();
  if (weights.size() != target_count)
    gltf_fail("mesh \"{}\" has {} morph targets and {} weights", mesh_name, target_count, weights.size());
  return weights;
}

}  // namespace

Deformation read_deformation(const GltfFile& file, const GltfNodes& nodes, const Json& node,
                             const Json& mesh_source, const Json& primitive, const Mesh& mesh) {
  Deformation result;
  const std::string mesh_name = mesh_source.value("name", "");
  const Json& first = mesh_source["primitives"].front();
  if (gltf_targets(primitive).size() != gltf_targets(first).size())
    gltf_fail("mesh \"{}\": its primitives differ in how many morph targets they have", mesh_name);
  result.targets = read_targets(file, primitive, mesh_name, mesh.positions.size());
  result.weights = read_target_weights(node, mesh_source, mesh_name, result.targets.size());
  if (const int skin = file.index(node, "skin", "skins"); skin >= 0) {
    const Json& source = file.list("skins")[std::size_t(skin)];
    const std::string name = source.value("name", fmt::format("skin {}", skin));
    result.skin.joints = read_joints(file, nodes, source, name);
    result.skin.joint_from_mesh = read_inverse_bind(file, source, name, result.skin.joints.size());
    read_weights(file, gltf_member(primitive, "attributes"), name, mesh.positions.size(), result.skin);
  }
  if (result.targets.empty() && result.skin.joints.empty()) return result;
  result.positions = mesh.positions;
  result.normals = mesh.normals;
  return result;
}

}  // namespace parvis::scene
