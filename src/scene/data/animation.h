// Keyframes (glTF 2.0, section 3.11) and what they give at a time.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

namespace parvis::scene {

enum class Interpolation : std::uint8_t { step, linear, cubic };

/// Keyframes of one property of one node.
struct AnimationChannel {
  enum class Property : std::uint8_t { translation, rotation, scale };
  int node = 0;
  Property property = Property::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times_s;  ///< ascending
  std::vector<glm::vec4>
      values;  ///< xyz or quaternion xyzw; three a key (in-tangent, value, out-tangent) if cubic
};

/// Keyframes of the weights of one node's morph targets.
struct WeightChannel {
  int node = 0;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times_s;              ///< ascending
  std::vector<std::vector<float>> values;  ///< one weight a target; three lists a key if cubic
};

struct Animation {
  std::string name;
  std::vector<AnimationChannel> channels;
  std::vector<WeightChannel> weights;
  float duration_s = 0.0f;
};

/// The time within an animation that repeats for ever.
float looped(const Animation& animation, double time_s);

/// The value at `time_s`; beyond the keys that of the nearest.
glm::vec4 sample(const AnimationChannel& channel, float time_s);
void sample(const WeightChannel& channel, float time_s, std::vector<float>& weights);

}  // namespace parvis::scene
