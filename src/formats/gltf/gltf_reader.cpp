#include "formats/gltf/gltf_reader.h"

#include <map>

#include "base/checked.h"
#include "base/json_guard.h"
#include "formats/gltf/gltf_animations.h"
#include "formats/gltf/gltf_deformation.h"
#include "formats/gltf/gltf_file.h"
#include "formats/gltf/gltf_materials.h"
#include "formats/gltf/gltf_meshes.h"
#include "formats/gltf/gltf_nodes.h"
#include "formats/gltf/gltf_values.h"
#include "formats/readers/packed_file.h"

namespace parvis::scene {
namespace {

using Json = GltfFile::Json;

/// The parts of the mesh that hangs on `node`. Skinned ones stand in the file's frame: their own node counts
/// for nothing.
void read_mesh(const GltfFile& file, const GltfNodes& nodes, int node, Model& model) {
  const Json& node_source = file.list("nodes")[std::size_t(nodes.gltf_of[std::size_t(node)])];
  const int mesh = file.index(node_source, "mesh", "meshes");
  if (mesh < 0) return;
  const Json& source = file.list("meshes")[std::size_t(mesh)];
  const std::string name = source.value("name", node_source.value("name", fmt::format("mesh {}", mesh)));
  const auto primitives = source.find("primitives");
  if (primitives == source.end()) return;
  for (const Json& primitive : *primitives) {
    const Json& extras = gltf_member(primitive, "extras");
    Part part;
    part.mesh = read_primitive(file, primitive, name);
    if (part.mesh.indices.empty()) continue;
    part.object = extras.value("object", name);
    part.node = node;
    const int material = file.index(primitive, "material", "materials");
    part.material = material < 0 ? int(model.materials.size()) - 1 : material;  // the last one is plain
    part.is_backdrop = extras.value("backdrop", Json()) == Json(true);  // others may use this word, too
    part.casts_shadow = !part.is_backdrop && extras.value("casts_shadow", true);
    Deformation deformation = read_deformation(file, nodes, node_source, source, primitive, part.mesh);
    if (!deformation.positions.empty()) {
      deformation.weights_node = node;
      if (!deformation.skin.joints.empty()) part.node = 0;
      part.deformation = std::make_shared<const Deformation>(std::move(deformation));
    }
    model.parts.push_back(std::move(part));
  }
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

/// Meshes are copied to each node that shows them: a file of some bytes may say so for any number of nodes.
void charge_meshes(const GltfFile& file, const GltfNodes& nodes) {
  std::map<int, std::optional<std::uint64_t>> known;
  std::optional<std::uint64_t> sum = 0;
  std::size_t shown = 0;
  for (const int node : nodes.gltf_of) {
    const int mesh =
        node == no_index ? -1 : file.index(file.list("nodes")[std::size_t(node)], "mesh", "meshes");
    if (mesh < 0) continue;
    ++shown;
    const auto [bytes, is_new] = known.try_emplace(mesh);
    if (is_new) bytes->second = bytes_of_mesh(file, mesh);
    if (sum) sum = bytes->second ? checked_sum({*sum, *bytes->second}) : std::nullopt;
  }
  gltf_charge(sum, "the geometry of {} nodes that show {} meshes", shown, known.size());
}

/// All nodes are there now, and with them all joints.
void deform_to_rest(Model& model) {
  const std::vector<glm::mat4> model_from_node = rest_pose(model);
  for (Part& part : model.parts) {
    if (!part.deformation) continue;
    deform(*part.deformation, part.deformation->weights, model_from_node, part.node, part.mesh);
    if (const Status status = check(part.mesh, "mesh \"" + part.object + "\", deformed"); !status)
      gltf_fail("{}", status.errors().front().message);
  }
}

Model read_model(const GltfFile& file, Errors& warnings) {
  Model model;
  model.name = formats::model_stem(file.path());
  model.nodes.front().name = "y_up";
  model.nodes.front().rotation = glm::angleAxis(glm::radians(90.0f), glm::vec3(1, 0, 0));
  read_materials(file, model, warnings);
  const GltfNodes nodes = read_nodes(file, model, warnings);
  charge_meshes(file, nodes);
  for (std::size_t node = 1; node < model.nodes.size(); ++node) read_mesh(file, nodes, int(node), model);
  deform_to_rest(model);
  model.animations = read_animations(file, nodes);
  if (model.parts.empty()) gltf_fail("no triangles are in this model");
  return model;
}

}  // namespace

Result<Model> read_gltf(const std::filesystem::path& file, Errors& warnings) {
  const FileLocation where{file.string(), 0, 0};
  try {
    return read_model(GltfFile(file), warnings);
  } catch (const GltfFile::GltfProblem& problem) {
    return Error{problem.message, where};
  } catch (const Json::exception& problem) {
    return error_at(where, "a value is not of the kind that glTF asks for ({})", json_reason(problem.what()));
  }
}

}  // namespace parvis::scene
