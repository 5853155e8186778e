#include "formats/gltf/gltf_animation_writer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace parvis::scene {
namespace {

using Json = GltfChunk::Json;
using Property = AnimationChannel::Property;

/// glTF asks for times that grow: two keys of one moment, a jump, become two moments.
std::vector<float> growing(std::vector<float> times_s) {
  times_s.front() = std::max(times_s.front(), 0.0f);
  for (std::size_t i = 1; i < times_s.size(); ++i)
    times_s[i] = std::max(times_s[i], std::nextafter(times_s[i - 1], std::numeric_limits<float>::infinity()));
  return times_s;
}

/// A sampler of keys with `components` floats each; a cubic key has its two tangents, too.
Json sampler_json(const std::vector<float>& times_s, Interpolation interpolation,
                  const std::vector<float>& values, int components, GltfChunk& chunk) {
  const char* type = components == 4 ? "VEC4" : components == 3 ? "VEC3" : "SCALAR";
  const char* name = interpolation == Interpolation::step    ? "STEP"
                     : interpolation == Interpolation::cubic ? "CUBICSPLINE"
                                                             : "LINEAR";
  const int input = chunk.add_times(growing(times_s));
  return {{"input", input}, {"output", chunk.add_keys(values, type, components)}, {"interpolation", name}};
}

WrittenChannel write_channel(const AnimationChannel& channel, GltfChunk& chunk) {
  const bool is_rotation = channel.property == Property::rotation;
  const int components = is_rotation ? 4 : 3;
  std::vector<float> values;
  for (std::size_t i = 0; i < channel.values.size(); ++i) {
    const bool is_tangent = channel.interpolation == Interpolation::cubic && i % 3 != 1;
    const float length = is_rotation && !is_tangent ? glm::length(channel.values[i]) : 1.0f;
    for (int c = 0; c < components; ++c)
      values.push_back(channel.values[i][c] / (length > 0.0f ? length : 1.0f));
  }
  const char* path = is_rotation ? "rotation" : channel.property == Property::scale ? "scale" : "translation";
  return {sampler_json(channel.times_s, channel.interpolation, values, components, chunk), path,
          channel.node};
}

WrittenChannel write_channel(const WeightChannel& channel, GltfChunk& chunk) {
  std::vector<float> values;
  for (const std::vector<float>& weights : channel.values)
    values.insert(values.end(), weights.begin(), weights.end());
  return {sampler_json(channel.times_s, channel.interpolation, values, 1, chunk), "weights", channel.node,
          channel.values.front().size()};
}

/// The file's nodes that a channel moves.
std::vector<int> moved_nodes(const WrittenChannel& channel, const WrittenObject& object,
                             const std::vector<WrittenMesh>& meshes) {
  if (channel.targets == 0) return {object.first_node + channel.node};
  std::vector<int> nodes;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    if (meshes[i].deformation && meshes[i].deformation->weights_node == channel.node &&
        meshes[i].deformation->targets.size() == channel.targets)
      nodes.push_back(object.node_of_mesh[i]);
  return nodes;
}

}  // namespace

std::vector<WrittenAnimation> write_keyframes(const Model& model, GltfChunk& chunk) {
  std::vector<WrittenAnimation> written;
  for (const Animation& animation : model.animations) {
    WrittenAnimation& one = written.emplace_back();
    one.name = animation.name;
    for (const AnimationChannel& channel : animation.channels)
      one.channels.push_back(write_channel(channel, chunk));
    for (const WeightChannel& channel : animation.weights)
      one.channels.push_back(write_channel(channel, chunk));
  }
  return written;
}

Json animation_json(const WrittenAnimation& animation, const WrittenObject& object,
                    const std::vector<WrittenMesh>& meshes) {
  Json json{{"channels", Json::array()}, {"samplers", Json::array()}};
  const bool is_named = !object.name.empty() && !animation.name.empty();
  const std::string name = object.name + (is_named ? ": " : "") + animation.name;
  if (!name.empty()) json["name"] = name;
  std::set<std::pair<int, std::string>> moved;  // glTF lets one channel move a node's property
  for (const WrittenChannel& channel : animation.channels) {
    for (const int node : moved_nodes(channel, object, meshes)) {
      if (!moved.insert({node, channel.path}).second) continue;
      json["channels"].push_back(
          {{"sampler", json["samplers"].size()}, {"target", {{"node", node}, {"path", channel.path}}}});
      json["samplers"].push_back(channel.sampler);
    }
  }
  return json;
}

}  // namespace parvis::scene
