#include "formats/gltf/gltf_mesh_writer.h"

#include <algorithm>

namespace parvis::scene {
namespace {

using Json = GltfChunk::Json;
using Component = GltfChunk::Component;
using Use = GltfChunk::Use;

constexpr std::size_t max_joints = 65536;  // a vertex names its joints by 16 bits

/// A deformed mesh hangs where its weights are animated: its skin places it wherever it hangs.
int hanging_node(const Part& part) {
  const bool follows_weights = part.deformation && part.deformation->weights_node != no_index;
  return follows_weights ? part.deformation->weights_node : part.node;
}

bool deform_alike(const Deformation* a, const Deformation* b) {
  if (!a || !b) return a == b;
  return a->targets.size() == b->targets.size() && a->weights == b->weights &&
         a->skin.joints == b->skin.joints && a->skin.joint_from_mesh == b->skin.joint_from_mesh;
}

int write_inverse_bind(const Skin& skin, GltfChunk& chunk) {
  std::vector<glm::mat4> matrices = skin.joint_from_mesh;
  for (glm::mat4& matrix : matrices)
    for (int column = 0; column < 4; ++column) matrix[column][3] = column == 3 ? 1.0f : 0.0f;
  return chunk.add(matrices, "MAT4", Component::float32, Use::other);
}

/// glTF wants each joint of a vertex once, and joint 0 where nothing pulls.
void write_skin(const Skin& skin, GltfChunk& chunk, Json& attributes) {
  std::vector<glm::u16vec4> joints(skin.weights.size(), glm::u16vec4(0));
  std::vector<glm::vec4> weights(skin.weights.size(), glm::vec4(0.0f));
  for (std::size_t v = 0; v < joints.size(); ++v) {
    int used = 0;
    for (int k = 0; k < 4; ++k) {
      if (skin.weights[v][k] == 0.0f) continue;
      const auto joint = std::uint16_t(skin.joints_of_vertex[v][k]);
      int at = 0;
      while (at < used && joints[v][at] != joint) ++at;
      used = std::max(used, at + 1);
      joints[v][at] = joint;
      weights[v][at] += skin.weights[v][k];
    }
  }
  attributes["JOINTS_0"] = chunk.add(joints, "VEC4", Component::uint16, Use::vertices);
  attributes["WEIGHTS_0"] = chunk.add(weights, "VEC4", Component::float32, Use::vertices);
}

Json targets_json(const Deformation& deformation, GltfChunk& chunk) {
  Json targets = Json::array();
  for (const MorphTarget& target : deformation.targets) {
    std::vector<glm::vec3> positions = target.positions;
    positions.resize(deformation.positions.size(), glm::vec3(0.0f));
    Json json{{"POSITION", chunk.add_positions(positions)}};
    if (!target.normals.empty()) json["NORMAL"] = chunk.add_vectors(target.normals);
    targets.push_back(json);
  }
  return targets;
}

Json primitive_json(const Part& part, int first_material, GltfChunk& chunk) {
  const Deformation* deformation = part.deformation.get();
  Json attributes{
      {"POSITION", chunk.add_positions(deformation ? deformation->positions : part.mesh.positions)},
      {"NORMAL", chunk.add_vectors(deformation ? deformation->normals : part.mesh.normals)},
      {"TEXCOORD_0", chunk.add(part.mesh.uvs, "VEC2", Component::float32, Use::vertices)}};
  if (!part.mesh.second_uvs.empty())
    attributes["TEXCOORD_1"] = chunk.add(part.mesh.second_uvs, "VEC2", Component::float32, Use::vertices);
  if (!part.mesh.colours.empty())
    attributes["COLOR_0"] = chunk.add(part.mesh.colours, "VEC4", Component::float32, Use::vertices);
  if (deformation && !deformation->skin.joints.empty()) write_skin(deformation->skin, chunk, attributes);
  Json primitive{{"attributes", attributes},
                 {"indices", chunk.add(part.mesh.indices, "SCALAR", Component::uint32, Use::indices)},
                 {"material", first_material + part.material},
                 {"extras", {{"object", part.object}}}};
  if (!part.casts_shadow) primitive["extras"]["casts_shadow"] = false;
  if (part.is_backdrop) primitive["extras"]["backdrop"] = true;
  if (deformation && !deformation->targets.empty()) primitive["targets"] = targets_json(*deformation, chunk);
  return primitive;
}

}  // namespace

Result<std::vector<WrittenMesh>> write_meshes(const Model& model, int first_material, GltfChunk& chunk,
                                              Json& meshes) {
  std::vector<WrittenMesh> written;
  for (const Part& part : model.parts) {
    if (part.mesh.indices.empty()) continue;
    const Deformation* deformation = part.deformation.get();
    const int node = hanging_node(part);
    auto mesh = std::find_if(written.begin(), written.end(), [&](const WrittenMesh& other) {
      return other.node == node && deform_alike(other.deformation, deformation);
    });
    if (mesh == written.end()) {
      mesh = written.insert(written.end(), {int(meshes.size()), node, deformation});
      meshes.push_back({{"name", part.object}, {"primitives", Json::array()}});
      if (deformation && !deformation->weights.empty()) meshes.back()["weights"] = deformation->weights;
      if (deformation && deformation->skin.joints.size() > max_joints)
        return error("\"{}\" hangs on {} joints; glTF can number {}", part.object,
                     deformation->skin.joints.size(), max_joints);
      if (deformation && !deformation->skin.joints.empty())
        mesh->inverse_bind = write_inverse_bind(deformation->skin, chunk);
    }
    meshes[std::size_t(mesh->mesh)]["primitives"].push_back(primitive_json(part, first_material, chunk));
  }
  return written;
}

}  // namespace parvis::scene
