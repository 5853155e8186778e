#include "formats/gltf/gltf_animations.h"

#include <algorithm>
#include <cmath>

#include "formats/gltf/gltf_values.h"

namespace parvis::scene {
namespace {

using Json = GltfFile::Json;
using Property = AnimationChannel::Property;

Property property_of(const std::string& path) {
  if (path == "translation") return Property::translation;
  if (path == "rotation") return Property::rotation;
  if (path == "scale") return Property::scale;
  gltf_fail("an animation moves \"{}\"; expected translation, rotation, scale or weights", path);
}

Interpolation interpolation_of(const Json& sampler) {
  const std::string name = sampler.value("interpolation", "LINEAR");
  return name == "STEP"          ? Interpolation::step
         : name == "CUBICSPLINE" ? Interpolation::cubic
                                 : Interpolation::linear;
}

bool are_finite(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
}

/// Times and values of a sampler; `components` values for each key, or three times as many if cubic.
struct Keys {
  Interpolation interpolation;
  std::vector<float> times_s, values;
};

Keys read_keys(const GltfFile& file, const Json& sampler, const std::string& animation,
               int accessor_components, std::size_t components) {
  const int input = file.index(sampler, "input", "accessors"),
            output = file.index(sampler, "output", "accessors");
  if (input < 0 || output < 0) gltf_fail("an animation sampler lacks its input or output");
  Keys keys{interpolation_of(sampler), file.floats(input, 1), file.floats(output, accessor_components)};
  const std::size_t wanted =
      keys.times_s.size() * components * (keys.interpolation == Interpolation::cubic ? 3 : 1);
  if (keys.times_s.empty() || keys.values.size() != wanted ||
      !std::is_sorted(keys.times_s.begin(), keys.times_s.end()) || !are_finite(keys.values) ||
      !are_finite(keys.times_s))
    gltf_fail("animation \"{}\": {} times and {} values; expected finite, ascending times and {} values",
              animation, keys.times_s.size(), keys.values.size(), wanted);
  return keys;
}

AnimationChannel node_channel(Keys keys, int node, Property property, std::size_t components) {
  AnimationChannel channel{node, property, keys.interpolation, std::move(keys.times_s), {}};
  channel.values.resize(keys.values.size() / components, glm::vec4(0.0f));
  for (std::size_t i = 0; i < keys.values.size(); ++i)
    channel.values[i / components][int(i % components)] = keys.values[i];
  return channel;
}

WeightChannel weight_channel(Keys keys, int node, std::size_t targets) {
  WeightChannel channel{node, keys.interpolation, std::move(keys.times_s), {}};
  for (auto key = keys.values.begin(); key != keys.values.end(); key += std::ptrdiff_t(targets))
    channel.values.emplace_back(key, key + std::ptrdiff_t(targets));
  return channel;
}

/// Number of morph targets of the mesh on a node; 0 where there is none.
std::size_t target_count(const GltfFile& file, int gltf_node) {
  const int mesh = file.index(file.list("nodes")[std::size_t(gltf_node)], "mesh", "meshes");
  if (mesh < 0) return 0;
  const Json& source = file.list("meshes")[std::size_t(mesh)];
  const Json primitives = source.value("primitives", Json::array());
  return primitives.empty() ? 0 : gltf_targets(primitives.front()).size();
}

void read_channel(const GltfFile& file, const GltfNodes& nodes, const Json& source, const Json& samplers,
                  Animation& animation) {
  const Json& target = gltf_member(source, "target");
  const std::string path = target.value("path", "");
  const int gltf_node = file.index(target, "node", "nodes");
  if (gltf_node < 0 || nodes.of_gltf[std::size_t(gltf_node)] == no_index) return;
  const int node = nodes.of_gltf[std::size_t(gltf_node)];
  const Json& sampler = samplers.at(source.value("sampler", std::size_t(0)));
  float end_s = 0.0f;
  if (path == "weights") {
    const std::size_t targets = target_count(file, gltf_node);
    if (targets == 0) return;
    animation.weights.push_back(
        weight_channel(read_keys(file, sampler, animation.name, 1, targets), node, targets));
    end_s = animation.weights.back().times_s.back();
  } else {
    const Property property = property_of(path);
    const int components = property == Property::rotation ? 4 : 3;
    animation.channels.push_back(
        node_channel(read_keys(file, sampler, animation.name, components, std::size_t(components)), node,
                     property, std::size_t(components)));
    end_s = animation.channels.back().times_s.back();
  }
  animation.duration_s = std::max(animation.duration_s, end_s);
}

}  // namespace

std::vector<Animation> read_animations(const GltfFile& file, const GltfNodes& nodes) {
  std::vector<Animation> animations;
  for (const Json& source : file.list("animations")) {
    Animation animation;
    animation.name = source.value("name", "");
    const Json samplers = source.value("samplers", Json::array());
    for (const Json& channel : source.value("channels", Json::array()))
      read_channel(file, nodes, channel, samplers, animation);
    if (!animation.channels.empty() || !animation.weights.empty()) animations.push_back(std::move(animation));
  }
  return animations;
}

}  // namespace parvis::scene
