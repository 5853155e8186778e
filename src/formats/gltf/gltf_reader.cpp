#include "formats/gltf/gltf_reader.h"

#include "base/json_guard.h"
#include "formats/gltf/gltf_animations.h"
#include "formats/gltf/gltf_deformation.h"
#include "formats/gltf/gltf_file.h"
#include "formats/gltf/gltf_materials.h"
#include "formats/gltf/gltf_meshes.h"
#include "formats/gltf/gltf_nodes.h"
#include "formats/gltf/gltf_values.h"

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
    part.casts_shadow = extras.value("casts_shadow", true);
    Deformation deformation = read_deformation(file, nodes, node_source, source, primitive, part.mesh);
    if (!deformation.positions.empty()) {
      deformation.weights_node = node;
      if (!deformation.skin.joints.empty()) part.node = 0;
      part.deformation = std::make_shared<const Deformation>(std::move(deformation));
    }
    model.parts.push_back(std::move(part));
  }
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
  model.name = file.path().stem().string();
  model.nodes.front().name = "y_up";
  model.nodes.front().rotation = glm::angleAxis(glm::radians(90.0f), glm::vec3(1, 0, 0));
  read_materials(file, model, warnings);
  const GltfNodes nodes = read_nodes(file, model, warnings);
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
