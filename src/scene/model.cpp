#include "scene/model.h"

#include <algorithm>
#include <cmath>
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

glm::quat quaternion(glm::vec4 xyzw) { return {xyzw.w, xyzw.x, xyzw.y, xyzw.z}; }

/// The value of a channel at `time_s` (glTF 2.0, appendix C).
glm::vec4 sample(const AnimationChannel& channel, float time_s) {
  using Interpolation = AnimationChannel::Interpolation;
  const std::vector<float>& times = channel.times_s;
  const bool is_cubic = channel.interpolation == Interpolation::cubic;
  const auto value = [&](std::size_t key) { return channel.values[is_cubic ? 3 * key + 1 : key]; };
  const auto after = std::upper_bound(times.begin(), times.end(), time_s);
  if (after == times.begin()) return value(0);
  if (after == times.end()) return value(times.size() - 1);
  const std::size_t key = std::size_t(after - times.begin()) - 1;
  const float step = times[key + 1] - times[key];
  const float t = (time_s - times[key]) / step;

  if (channel.interpolation == Interpolation::step) return value(key);
  if (is_cubic) {
    const glm::vec4 out = channel.values[3 * key + 2] * step, in = channel.values[3 * key + 3] * step;
    const float t2 = t * t, t3 = t2 * t;
    return (2.0f * t3 - 3.0f * t2 + 1.0f) * value(key) + (t3 - 2.0f * t2 + t) * out +
           (3.0f * t2 - 2.0f * t3) * value(key + 1) + (t3 - t2) * in;
  }
  if (channel.property != AnimationChannel::Property::rotation)
    return glm::mix(value(key), value(key + 1), t);
  const glm::quat turned = glm::slerp(quaternion(value(key)), quaternion(value(key + 1)), t);
  return {turned.x, turned.y, turned.z, turned.w};
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
  const float time = animation.duration_s > 0.0f ? std::fmod(time_s, animation.duration_s) : 0.0f;
  std::vector<ModelNode> nodes = model.nodes;
  for (const AnimationChannel& channel : animation.channels) {
    ModelNode& node = nodes[std::size_t(channel.node)];
    const glm::vec4 value = sample(channel, time);
    switch (channel.property) {
      case Property::translation:
        node.translation = glm::vec3(value);
        break;
      case Property::rotation:
        node.rotation = glm::normalize(quaternion(value));
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
