#include "scene/data/animation.h"

#include <algorithm>
#include <cmath>

namespace parvis::scene {
namespace {

/// The two keys between which a time lies. Beyond the keys, both are the nearest.
struct KeyInterval {
  std::size_t before, after;
  float step_s;  ///< from one to the other
  float t;       ///< 0..1 of it
};

KeyInterval interval(const std::vector<float>& times_s, float time_s) {
  const auto found = std::upper_bound(times_s.begin(), times_s.end(), time_s);
  if (found == times_s.begin()) return {0, 0, 0.0f, 0.0f};
  const std::size_t after = std::size_t(found - times_s.begin());
  if (found == times_s.end()) return {after - 1, after - 1, 0.0f, 0.0f};
  const float step_s = times_s[after] - times_s[after - 1];
  return {after - 1, after, step_s, (time_s - times_s[after - 1]) / step_s};
}

/// glTF 2.0, appendix C.5: values of three a key.
template <class T>
T cubic(const KeyInterval& keys, const T& before, const T& out_tangent, const T& in_tangent, const T& after) {
  const float t = keys.t, t2 = t * t, t3 = t2 * t;
  return (2.0f * t3 - 3.0f * t2 + 1.0f) * before + ((t3 - 2.0f * t2 + t) * keys.step_s) * out_tangent +
         (3.0f * t2 - 2.0f * t3) * after + ((t3 - t2) * keys.step_s) * in_tangent;
}

glm::quat quaternion(glm::vec4 xyzw) { return {xyzw.w, xyzw.x, xyzw.y, xyzw.z}; }

}  // namespace

float looped(const Animation& animation, double time_s) {
  if (!(animation.duration_s > 0.0f)) return 0.0f;
  const double duration_s = double(animation.duration_s);
  return float(time_s - duration_s * std::floor(time_s / duration_s));
}

glm::vec4 sample(const AnimationChannel& channel, float time_s) {
  const KeyInterval keys = interval(channel.times_s, time_s);
  const std::vector<glm::vec4>& values = channel.values;
  switch (channel.interpolation) {
    case Interpolation::step:
      return values[keys.before];
    case Interpolation::cubic:
      return cubic(keys, values[3 * keys.before + 1], values[3 * keys.before + 2], values[3 * keys.after],
                   values[3 * keys.after + 1]);
    case Interpolation::linear:
      break;
  }
  if (channel.property != AnimationChannel::Property::rotation)
    return glm::mix(values[keys.before], values[keys.after], keys.t);
  const glm::quat turned =
      glm::slerp(quaternion(values[keys.before]), quaternion(values[keys.after]), keys.t);
  return {turned.x, turned.y, turned.z, turned.w};
}

void sample(const WeightChannel& channel, float time_s, std::vector<float>& weights) {
  const KeyInterval keys = interval(channel.times_s, time_s);
  const auto& values = channel.values;
  for (std::size_t target = 0; target < weights.size(); ++target) {
    switch (channel.interpolation) {
      case Interpolation::step:
        weights[target] = values[keys.before][target];
        break;
      case Interpolation::linear:
        weights[target] = glm::mix(values[keys.before][target], values[keys.after][target], keys.t);
        break;
      case Interpolation::cubic:
        weights[target] =
            cubic(keys, values[3 * keys.before + 1][target], values[3 * keys.before + 2][target],
                  values[3 * keys.after][target], values[3 * keys.after + 1][target]);
        break;
    }
  }
}

}  // namespace parvis::scene
