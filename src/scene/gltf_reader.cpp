#include "scene/gltf_reader.h"

#include "scene/gltf_animations.h"
#include "scene/gltf_file.h"
#include "scene/gltf_materials.h"
#include "scene/gltf_meshes.h"
#include "scene/gltf_nodes.h"
#include "scene/gltf_skin.h"
#include "scene/gltf_values.h"

namespace parvis::scene {
namespace {

using Json = GltfFile::Json;

/// A primitive that joints bend.
struct SkinnedPart {
  std::size_t part;
  int skin;
  const Json* attributes;
};

/// The parts of the mesh that hangs on `node`.
void read_mesh(const GltfFile& file, int node, const Json& node_source, Model& model,
               std::vector<SkinnedPart>& skinned) {
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
    if (const int skin = file.index(node_source, "skin", "skins"); skin >= 0)
      skinned.push_back({model.parts.size(), skin, &gltf_member(primitive, "attributes")});
    model.parts.push_back(std::move(part));
  }
}

/// Skinned parts stand in the rest pose of their joints, in the file's frame: their own node counts for
/// nothing.
void bend_skinned_parts(const GltfFile& file, const GltfNodes& nodes, const std::vector<SkinnedPart>& skinned,
                        Model& model) {
  const std::vector<glm::mat4> model_from_node = rest_pose(model);
  const glm::mat4 file_from_model = glm::inverse(model_from_node.front());
  for (const SkinnedPart& each : skinned) {
    Part& part = model.parts[each.part];
    const GltfSkin skin = read_skin(file, each.skin);
    std::vector<glm::mat4> file_from_mesh;
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
      const int node = nodes.of_gltf[std::size_t(skin.joints[i])];
      if (node == no_index)
        gltf_fail("skin \"{}\": joint {} is missing from the scene", skin.name, skin.joints[i]);
      file_from_mesh.push_back(file_from_model * model_from_node[std::size_t(node)] *
                               skin.joint_from_mesh[i]);
    }
    bend(part.mesh, read_skin_weights(file, *each.attributes, skin, part.mesh.positions.size()),
         file_from_mesh);
    part.node = 0;
    if (const Status status = check(part.mesh, "skin \"" + skin.name + "\""); !status)
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
  std::vector<SkinnedPart> skinned;
  for (std::size_t node = 1; node < model.nodes.size(); ++node)
    read_mesh(file, int(node), file.list("nodes")[std::size_t(nodes.gltf_of[node])], model, skinned);
  bend_skinned_parts(file, nodes, skinned, model);
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
    return error_at(where, "a value is not of the kind that glTF asks for ({})", problem.what());
  }
}

}  // namespace parvis::scene
