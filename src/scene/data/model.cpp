#include "scene/data/model.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace parvis::scene {
namespace {

glm::dmat4 local_transform(const ModelNode& node) {
  return glm::translate(glm::dmat4(1.0), node.translation) * glm::mat4_cast(node.rotation) *
         glm::scale(glm::dmat4(1.0), node.scale);
}

std::vector<glm::dmat4> model_from_nodes(const std::vector<ModelNode>& nodes) {
  std::vector<glm::dmat4> pose;
  pose.reserve(nodes.size());
  for (const ModelNode& node : nodes) {
    const glm::dmat4 local = local_transform(node);
    pose.push_back(node.parent == no_index ? local : pose[std::size_t(node.parent)] * local);
  }
  return pose;
}

std::vector<glm::mat4> rounded(const std::vector<glm::dmat4>& pose) { return {pose.begin(), pose.end()}; }

}  // namespace

float wrapped(float coordinate, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp(coordinate, 0.0f, 1.0f);
  if (wrap == Wrap::repeat) return coordinate - std::floor(coordinate);
  const float in_two = coordinate - 2.0f * std::floor(0.5f * coordinate);
  return in_two > 1.0f ? 2.0f - in_two : in_two;
}

std::size_t Model::triangle_count() const {
  std::size_t count = 0;
  for (const Part& part : parts) count += part.mesh.triangle_count();
  return count;
}

std::vector<glm::dmat4> exact_rest_pose(const Model& model) { return model_from_nodes(model.nodes); }

std::vector<glm::mat4> rest_pose(const Model& model) { return rounded(exact_rest_pose(model)); }

std::vector<glm::mat4> pose_at(const Model& model, const Animation& animation, float time_s) {
  using Property = AnimationChannel::Property;
  std::vector<ModelNode> nodes = model.nodes;
  for (const AnimationChannel& channel : animation.channels) {
    ModelNode& node = nodes[std::size_t(channel.node)];
    const glm::vec4 value = sample(channel, time_s);
    switch (channel.property) {
      case Property::translation:
        node.translation = glm::dvec3(value);
        break;
      case Property::rotation:
        node.rotation = glm::normalize(glm::dquat(value.w, value.x, value.y, value.z));
        break;
      case Property::scale:
        node.scale = glm::dvec3(value);
        break;
    }
  }
  return rounded(model_from_nodes(nodes));
}

Bounds bounds(const Model& model) {
  const std::vector<glm::mat4> pose = rest_pose(model);
  Bounds all;
  for (const Part& part : model.parts) all.add(transformed(pose[std::size_t(part.node)], part.mesh.bounds()));
  return all;
}

}  // namespace parvis::scene
