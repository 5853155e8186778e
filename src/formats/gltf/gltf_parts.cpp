#include "formats/gltf/gltf_parts.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "base/checked.h"
#include "formats/gltf/gltf_deformation.h"
#include "formats/gltf/gltf_meshes.h"
#include "formats/gltf/gltf_values.h"
#include "formats/readers/local_origin.h"

namespace parvis::scene {
namespace {

using Json = GltfFile::Json;
constexpr const char* instancing = "EXT_mesh_gpu_instancing";

/// Accessor of an attribute of a node's instances; -1 where there is none.
int instance_accessor(const GltfFile& file, const Json& node, const char* name) {
  return file.index(gltf_member(gltf_extension(node, instancing), "attributes"), name, "accessors");
}

/// How often a node shows its mesh.
std::size_t instance_count(const GltfFile& file, const Json& node) {
  if (gltf_extension(node, instancing).empty()) return 1;
  std::size_t count = 0;
  for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"})
    if (const int accessor = instance_accessor(file, node, name); accessor >= 0)
      count = std::max(count, file.element_count(accessor));
  return count;
}

/// Bytes that the vertices and indices of a mesh take in a model, by the counts that its accessors claim;
/// none where that is beyond 64 bits.
std::optional<std::uint64_t> bytes_of_mesh(const GltfFile& file, int mesh) {
  constexpr std::uint64_t vertex_bytes = 2 * sizeof(glm::vec3) + sizeof(glm::vec2);
  std::optional<std::uint64_t> sum = 0;
  const Json& source = file.list("meshes")[std::size_t(mesh)];
  for (const Json& primitive : source.value("primitives", Json::array())) {
    const int positions = file.index(gltf_member(primitive, "attributes"), "POSITION", "accessors"),
              indices = file.index(primitive, "indices", "accessors");
    const std::uint64_t vertices = positions < 0 ? 0 : file.element_count(positions);
    const auto of_vertices = checked_product({vertices, vertex_bytes}),
               of_indices = checked_product({indices < 0 ? vertices : file.element_count(indices), 4});
    if (!sum || !of_vertices || !of_indices) return std::nullopt;
    sum = checked_sum({*sum, *of_vertices, *of_indices});
  }
  return sum;
}

/// Meshes are copied to each node and instance that shows them: a file of some bytes may say so for any
/// number.
void charge_meshes(const GltfFile& file, const GltfNodes& nodes) {
  std::map<int, std::optional<std::uint64_t>> known;
  std::optional<std::uint64_t> sum = 0;
  std::size_t shown = 0;
  for (const int node : nodes.gltf_of) {
    if (node == no_index) continue;
    const Json& source = file.list("nodes")[std::size_t(node)];
    const int mesh = file.index(source, "mesh", "meshes");
    if (mesh < 0) continue;
    const std::size_t count = instance_count(file, source);
    shown += count;
    const auto [bytes, is_new] = known.try_emplace(mesh);
    if (is_new) bytes->second = bytes_of_mesh(file, mesh);
    const auto of_all = bytes->second ? checked_product({*bytes->second, count}) : std::nullopt;
    if (sum) sum = of_all ? checked_sum({*sum, *of_all}) : std::nullopt;
  }
  gltf_charge(sum, "the geometry of {} nodes that show {} meshes", shown, known.size());
}

/// The other side of the plane x = 0.
void mirror(Part& part) {
  const auto turn = [](std::vector<glm::vec3>& list) {
    for (glm::vec3& v : list) v.x = -v.x;
  };
  turn(part.mesh.positions), turn(part.mesh.normals);
  for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3)
    std::swap(part.mesh.indices[i + 1], part.mesh.indices[i + 2]);
  if (!part.deformation) return;
  auto deformation = std::make_shared<Deformation>(*part.deformation);
  turn(deformation->positions), turn(deformation->normals);
  for (MorphTarget& target : deformation->targets) turn(target.positions), turn(target.normals);
  part.deformation = std::move(deformation);
}

class PartReader {
 public:
  PartReader(const GltfFile& file, const GltfNodes& nodes, const std::vector<UvSets>& sets, Model& model,
             FileAccount& account)
      : file_(file),
        nodes_(nodes),
        sets_(sets),
        model_(model),
        account_(account),
        pose_(exact_rest_pose(model)) {}

  void read() {
    std::vector<char> is_shown(file_.list("meshes").size(), 0);
    for (std::size_t node = 1; node < nodes_.gltf_of.size(); ++node) {
      if (nodes_.gltf_of[node] == no_index) continue;
      const Json& source = file_.list("nodes")[std::size_t(nodes_.gltf_of[node])];
      const int mesh = file_.index(source, "mesh", "meshes");
      if (mesh < 0 || nodes_.is_hidden[node] != 0) continue;
      if (!is_shown[std::size_t(mesh)])
        count_primitives(file_, file_.list("meshes")[std::size_t(mesh)], sets_, account_);
      is_shown[std::size_t(mesh)] = 1;
      const std::vector<Part> parts = parts_of(int(node), source, mesh);
      for (const int host : hosts_of(int(node), source))
        for (const Part& part : parts) place(part, host);
    }
    for (std::size_t mesh = 0; mesh < is_shown.size(); ++mesh)
      if (!is_shown[mesh])
        account_.unneeded("meshes", "no visible node shows them",
                          file_.list("meshes")[mesh].value("name", fmt::format("mesh {}", mesh)));
  }

 private:
  /// Parts of the mesh of a node, in the node's frame. Skinned ones stand in the file's frame: their own node
  /// counts for nothing.
  std::vector<Part> parts_of(int node, const Json& node_source, int mesh) const {
    std::vector<Part> parts;
    const Json& source = file_.list("meshes")[std::size_t(mesh)];
    const std::string name = source.value("name", node_source.value("name", fmt::format("mesh {}", mesh)));
    const auto primitives = source.find("primitives");
    if (primitives == source.end()) return parts;
    for (const Json& primitive : *primitives) {
      const Json& extras = gltf_member(primitive, "extras");
      const int material = file_.index(primitive, "material", "materials");
      Part part;
      part.material = material < 0 ? int(model_.materials.size()) - 1 : material;  // the last one is plain
      part.mesh = read_primitive(file_, primitive, name, sets_[std::size_t(part.material)]);
      if (part.mesh.indices.empty()) continue;
      part.object = extras.value("object", name);
      part.node = node;
      part.is_backdrop = extras.value("backdrop", Json()) == Json(true);  // others may use this word, too
      part.casts_shadow = !part.is_backdrop && extras.value("casts_shadow", true);
      Deformation deformation = read_deformation(file_, nodes_, node_source, source, primitive, part.mesh);
      if (!deformation.positions.empty()) {
        deformation.weights_node = node;
        if (!deformation.skin.joints.empty()) part.node = 0;
        part.deformation = std::make_shared<const Deformation>(std::move(deformation));
      }
      parts.push_back(std::move(part));
    }
    return parts;
  }

  /// The nodes of the model that show a mesh: the node itself, or one for each of its instances.
  std::vector<int> hosts_of(int node, const Json& source) {
    if (gltf_extension(source, instancing).empty()) return {node};
    const auto values = [&](const char* name, int components) {
      const int accessor = instance_accessor(file_, source, name);
      return accessor < 0 ? std::vector<float>() : file_.floats(accessor, components);
    };
    const std::vector<float> translations = values("TRANSLATION", 3), rotations = values("ROTATION", 4),
                             scales = values("SCALE", 3);
    const std::size_t count = instance_count(file_, source);
    const auto fits = [&](const std::vector<float>& list, std::size_t components) {
      return list.empty() || list.size() == count * components;
    };
    if (!fits(translations, 3) || !fits(rotations, 4) || !fits(scales, 3))
      gltf_fail("node \"{}\": the attributes of its instances ({}) are not equally many",
                source.value("name", ""), instancing);
    std::vector<int> hosts;
    for (std::size_t i = 0; i < count; ++i) {
      ModelNode instance{.name = "", .parent = node};
      for (int k = 0; k < 3; ++k) {
        if (!translations.empty()) instance.translation[k] = double(translations[3 * i + std::size_t(k)]);
        if (!scales.empty()) instance.scale[k] = double(scales[3 * i + std::size_t(k)]);
      }
      if (!rotations.empty()) {
        const float* q = &rotations[4 * i];
        const glm::dquat rotation{glm::quat(q[3], q[0], q[1], q[2])};
        if (const double length = glm::length(rotation); length > 0.0) instance.rotation = rotation / length;
      }
      hosts.push_back(append(instance));
    }
    account_.used("instances", count);
    return hosts;
  }

  int append(const ModelNode& node) {
    const glm::dmat4 local = glm::translate(glm::dmat4(1.0), node.translation) *
                             glm::mat4_cast(node.rotation) * glm::scale(glm::dmat4(1.0), node.scale);
    model_.nodes.push_back(node);
    pose_.push_back(pose_[std::size_t(node.parent)] * local);
    return int(model_.nodes.size()) - 1;
  }

  void place(Part part, int host) {
    const bool is_skinned = part.deformation && !part.deformation->skin.joints.empty();
    if (!is_skinned) {
      ModelNode inner{.name = "", .parent = host};
      const bool mirrors = glm::determinant(glm::dmat3(pose_[std::size_t(host)])) < 0.0;
      if (mirrors) inner.scale.x = -1.0, mirror(part);
      const Bounds bounds = part.mesh.bounds();
      glm::dvec3 far(0.0);
      if (!part.deformation) far = formats::local_origin(glm::dvec3(bounds.min), glm::dvec3(bounds.max));
      for (glm::vec3& position : part.mesh.positions) position = glm::vec3(glm::dvec3(position) - far);
      inner.translation = inner.scale * far;
      formats::note_single_precision(far, "the file has", account_);
      part.node = mirrors || far != glm::dvec3(0.0) ? append(inner) : host;
    }
    model_.parts.push_back(std::move(part));
  }

  const GltfFile& file_;
  const GltfNodes& nodes_;
  const std::vector<UvSets>& sets_;
  Model& model_;
  FileAccount& account_;
  std::vector<glm::dmat4> pose_;
};

}  // namespace

void read_parts(const GltfFile& file, const GltfNodes& nodes, const std::vector<UvSets>& sets, Model& model,
                FileAccount& account) {
  charge_meshes(file, nodes);
  PartReader(file, nodes, sets, model, account).read();
}

}  // namespace parvis::scene
