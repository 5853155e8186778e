#include "scene/data/model.h"

#include <glm/gtc/matrix_transform.hpp>

namespace parvis::scene {
namespace {

glm::mat4 local_transform(const ModelNode& node) {
  return glm::translate(glm::mat4(1.0f), node.translation) * glm::mat4_cast(node.rotation) *
         glm::scale(glm::mat4(1.0f), node.scale);
}

std::vector<glm::mat4> model_from_nodes(const std::vector<ModelNode>& nodes) {
  std::vector<glm::mat4> pose;
  pose.reserve(nodes.size());
  for (const ModelNode& node : nodes) {
    const glm::mat4 local = local_transform(node);
    pose.push_back(node.parent == no_index ? local : pose[std::size_t(node.parent)] * local);
  }
  return pose;
}

}  // namespace

std::size_t Model::triangle_count() const {
  std::size_t count = 0;
  for (const Part& part : parts) count += part.mesh.triangle_count();
  return count;
}

std::vector<glm::mat4> rest_pose(const Model& model) { return model_from_nodes(model.nodes); }

std::vector<glm::mat4> pose_at(const Model& model, const Animation& animation, float time_s) {
  using Property = AnimationChannel::Property;
  std::vector<ModelNode> nodes = model.nodes;
  for (const AnimationChannel& channel : animation.channels) {
    ModelNode& node = nodes[std::size_t(channel.node)];
    const glm::vec4 value = sample(channel, time_s);
    switch (channel.property) {
      case Property::translation:
        node.translation = glm::vec3(value);
        break;
      case Property::rotation:
        node.rotation = glm::normalize(glm::quat(value.w, value.x, value.y, value.z));
        break;
      case Property::scale:
        node.scale = glm::vec3(value);
        break;
    }
  }
  return model_from_nodes(nodes);
}

Bounds bounds(const Model& model) {
  const std::vector<glm::mat4> pose = rest_pose(model);
  Bounds all;
  for (const Part& part : model.parts) all.add(transformed(pose[std::size_t(part.node)], part.mesh.bounds()));
  return all;
}

}  // namespace parvis::scene
