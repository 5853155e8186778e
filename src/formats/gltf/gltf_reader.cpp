#include "formats/gltf/gltf_reader.h"

#include <limits>
#include <utility>

#include "base/json_guard.h"
#include "formats/gltf/gltf_animations.h"
#include "formats/gltf/gltf_extensions.h"
#include "formats/gltf/gltf_file.h"
#include "formats/gltf/gltf_materials.h"
#include "formats/gltf/gltf_nodes.h"
#include "formats/gltf/gltf_parts.h"
#include "formats/gltf/gltf_transform.h"
#include "formats/gltf/gltf_values.h"
#include "formats/readers/local_origin.h"
#include "formats/readers/packed_file.h"

namespace parvis::scene {
namespace {

using Json = GltfFile::Json;

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

/// A skeleton that mirrors what hangs on it turns its triangles round.
void wind_skinned(Model& model) {
  const std::vector<glm::dmat4> pose = exact_rest_pose(model);
  for (Part& part : model.parts) {
    if (!part.deformation || part.deformation->skin.joints.empty()) continue;
    const Skin& skin = part.deformation->skin;
    int mirroring = 0;
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
      const glm::dmat4 model_from_mesh =
          pose[std::size_t(skin.joints[i])] * glm::dmat4(skin.joint_from_mesh[i]);
      mirroring += glm::determinant(glm::dmat3(model_from_mesh)) < 0.0 ? 1 : -1;
    }
    if (mirroring <= 0) continue;
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3)
      std::swap(part.mesh.indices[i + 1], part.mesh.indices[i + 2]);
  }
}

/// Takes coordinates of a national grid off the whole model, exactly: its root carries their negative.
void settle_origin(Model& model, FileAccount& account) {
  const std::vector<glm::dmat4> pose = exact_rest_pose(model);
  glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
  for (const Part& part : model.parts) {
    const Bounds bounds = part.mesh.bounds();
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 at(corner & 1 ? bounds.max.x : bounds.min.x, corner & 2 ? bounds.max.y : bounds.min.y,
                          corner & 4 ? bounds.max.z : bounds.min.z);
      const glm::dvec3 in_model(pose[std::size_t(part.node)] * glm::dvec4(at, 1.0));
      low = glm::min(low, in_model), high = glm::max(high, in_model);
    }
  }
  model.origin = formats::local_origin(low, high);
  model.nodes.front().translation = -model.origin;
  formats::note_origin(model.origin, model.map, account);
}

/// Counts the file's contents beside nodes, meshes and materials.
void count_others(const GltfFile& file, const Model& model, FileAccount& account) {
  account.settle("animations", file.list("animations").size(), model.animations.size(),
                 "they move nothing of the scene");
  account.left_out("cameras", "cameras of models are not read; write camera() nodes", "",
                   file.list("cameras").size());
  const Json& lights = gltf_extension(file.json(), "KHR_lights_punctual");
  for (const Json& light : lights.value("lights", Json::array()))
    account.left_out("lights", "lamps of models are not read; write lamp() nodes", light.value("name", ""));
}

Model read_model(const GltfFile& file, FileAccount& account, Errors& warnings) {
  Model model;
  model.name = formats::model_stem(file.path());
  model.nodes.front().name = "y_up";
  model.nodes.front().rotation = glm::quat_cast(glm::dmat3(z_up_from_y_up()));
  count_extensions(file, account);
  const std::vector<UvSets> sets = read_materials(file, model, account, warnings);
  const GltfNodes nodes = read_nodes(file, model, account, warnings);
  read_parts(file, nodes, sets, model, account);
  wind_skinned(model);
  settle_origin(model, account);
  deform_to_rest(model);
  model.animations = read_animations(file, nodes);
  count_others(file, model, account);
  if (model.parts.empty()) gltf_fail("no triangles are in this model");
  return model;
}

}  // namespace

Result<formats::FileContent> read_gltf_content(const std::filesystem::path& file, Errors& warnings) {
  const FileLocation where{file.string(), 0, 0};
  try {
    FileAccount account("glTF 2.0");
    Model model = read_model(GltfFile(file), account, warnings);
    return formats::FileContent{std::move(model), std::move(account)};
  } catch (const GltfFile::GltfProblem& problem) {
    return Error{problem.message, where};
  } catch (const Json::exception& problem) {
    return error_at(where, "a value is not of the kind that glTF asks for ({})", json_reason(problem.what()));
  }
}

Result<Model> read_gltf(const std::filesystem::path& file, Errors& warnings) {
  Result<formats::FileContent> content = read_gltf_content(file, warnings);
  if (!content) return content.errors();
  return std::move(content->model);
}

}  // namespace parvis::scene
