#include "formats/meshes/model_assembly.h"

namespace parvis::scene {
namespace {

void shift(int& index, int offset) {
  if (index != no_index) index += offset;
}

Material with_textures_from(Material material, int first_texture) {
  shift(material.base_colour_texture, first_texture);
  shift(material.normal_texture, first_texture);
  shift(material.surface_texture, first_texture);
  shift(material.emission_texture, first_texture);
  return material;
}

std::shared_ptr<const Deformation> with_nodes_from(const Deformation& deformation, int first_node) {
  auto moved = std::make_shared<Deformation>(deformation);
  shift(moved->weights_node, first_node);
  for (int& joint : moved->skin.joints) joint += first_node;
  return moved;
}

/// Appends all of `other`, its roots below the node `parent`.
void append(Model& model, const Model& other, int parent) {
  const int first_node = int(model.nodes.size()), first_material = int(model.materials.size()),
            first_texture = int(model.textures.size());
  model.textures.insert(model.textures.end(), other.textures.begin(), other.textures.end());
  for (const Material& material : other.materials)
    model.materials.push_back(with_textures_from(material, first_texture));
  for (ModelNode node : other.nodes) {
    node.parent = node.parent == no_index ? parent : node.parent + first_node;
    model.nodes.push_back(std::move(node));
  }
  for (Part part : other.parts) {
    part.node += first_node, part.material += first_material;
    if (part.deformation) part.deformation = with_nodes_from(*part.deformation, first_node);
    model.parts.push_back(std::move(part));
  }
  for (Animation animation : other.animations) {
    for (AnimationChannel& channel : animation.channels) channel.node += first_node;
    for (WeightChannel& channel : animation.weights) channel.node += first_node;
    model.animations.push_back(std::move(animation));
  }
}

}  // namespace

void mount(Model& model, const Model& part, const Mount& mount) {
  const int node = int(model.nodes.size());
  model.nodes.push_back({.name = mount.name, .translation = mount.position});
  model.nodes.push_back(
      {.name = "", .parent = node, .rotation = mount.rotation, .scale = glm::vec3(mount.scale)});
  append(model, part, node + 1);
}

Model placed(const Model& model, glm::vec3 position, const glm::quat& rotation, float scale) {
  Model result;
  result.name = model.name;
  result.origin = model.origin;
  result.nodes = {
      {.name = "placed", .translation = position, .rotation = rotation, .scale = glm::vec3(scale)}};
  append(result, model, 0);
  return result;
}

}  // namespace parvis::scene
