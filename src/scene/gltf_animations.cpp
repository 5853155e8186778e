#include "scene/gltf_animations.h"

#include <algorithm>
#include <cmath>

#include "scene/gltf_values.h"

namespace parvis::scene {
namespace {

using Json = GltfFile::Json;
using Property = AnimationChannel::Property;
using Interpolation = AnimationChannel::Interpolation;

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

void read_keys(const GltfFile& file, const Json& sampler, const std::string& animation,
               AnimationChannel& channel) {
  const int input = file.index(sampler, "input", "accessors"),
            output = file.index(sampler, "output", "accessors");
  if (input < 0 || output < 0) gltf_fail("an animation sampler lacks its input or output");
  channel.interpolation = interpolation_of(sampler);
  channel.times_s = file.floats(input, 1);
  const std::size_t components = channel.property == Property::rotation ? 4 : 3;
  const std::vector<float> values = file.floats(output, int(components));
  channel.values.resize(values.size() / components, glm::vec4(0.0f));
  for (std::size_t i = 0; i < values.size(); ++i)
    channel.values[i / components][int(i % components)] = values[i];

  const std::size_t wanted = channel.times_s.size() * (channel.interpolation == Interpolation::cubic ? 3 : 1);
  if (channel.times_s.empty() || channel.values.size() != wanted ||
      !std::is_sorted(channel.times_s.begin(), channel.times_s.end()) || !are_finite(values) ||
      !are_finite(channel.times_s))
    gltf_fail("animation \"{}\": {} times and {} values; expected finite, ascending times and as many values",
              animation, channel.times_s.size(), channel.values.size());
}

void read_channel(const GltfFile& file, const GltfNodes& nodes, const Json& source, const Json& samplers,
                  Animation& animation) {
  const Json& target = gltf_member(source, "target");
  const std::string path = target.value("path", "");
  const int gltf_node = file.index(target, "node", "nodes");
  if (gltf_node < 0 || nodes.of_gltf[std::size_t(gltf_node)] == no_index || path == "weights") return;
  AnimationChannel channel;
  channel.node = nodes.of_gltf[std::size_t(gltf_node)];
  channel.property = property_of(path);
  read_keys(file, samplers.at(source.value("sampler", std::size_t(0))), animation.name, channel);
  animation.duration_s = std::max(animation.duration_s, channel.times_s.back());
  animation.channels.push_back(std::move(channel));
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
    if (!animation.channels.empty()) animations.push_back(std::move(animation));
  }
  return animations;
}

}  // namespace parvis::scene
