// Keyframe animation (glTF 2.0, section 3.11): channels and their values at a time.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

namespace parvis::scene {

/// Interpolation between keys, as in glTF 2.0, appendix C.
enum class Interpolation : std::uint8_t { step, linear, cubic };

/// Keyframes of one property of one node.
struct AnimationChannel {
  enum class Property : std::uint8_t { translation, rotation, scale };
  int node = 0;
  Property property = Property::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times_s;  ///< ascending
  /// Translation or scale xyz, or quaternion xyzw; three per key (in-tangent, value, out-tangent) if cubic.
  std::vector<glm::vec4> values;
};

/// Keyframes of the weights of one node's morph targets.
struct WeightChannel {
  int node = 0;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times_s;              ///< ascending
  std::vector<std::vector<float>> values;  ///< one weight per target; three lists per key if cubic
};

/// A named animation of a model: transforms of its nodes and weights of their morph targets. `duration_s` is
/// the time of the last key.
struct Animation {
  std::string name;
  std::vector<AnimationChannel> channels;
  std::vector<WeightChannel> weights;
  float duration_s = 0.0f;
};

/// Maps a time onto the animation, which repeats: 0 <= result < duration; 0 if the animation has no duration.
float looped(const Animation& animation, double time_s);

/// Value of a channel at `time_s`; before the first and after the last key, that key's value.
glm::vec4 sample(const AnimationChannel& channel, float time_s);
/// Writes the value of each morph target at `time_s` into `weights`, whose size is the number of targets.
void sample(const WeightChannel& channel, float time_s, std::vector<float>& weights);

}  // namespace parvis::scene
