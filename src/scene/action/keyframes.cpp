#include "scene/action/keyframes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace parvis::action {
namespace {

constexpr double tangent_step_s = 1e-3;

/// The key before `time_s`, of those that have one behind them.
std::size_t segment_at(const std::vector<Keyframe>& keys, double time_s) {
  const auto after = std::upper_bound(keys.begin(), keys.end(), time_s,
                                      [](double time, const Keyframe& key) { return time < key.time_s; });
  return std::min(std::size_t(std::max<std::ptrdiff_t>(after - keys.begin() - 1, 0)), keys.size() - 2);
}

/// Metres per second at a key: through its neighbours; at the ends of the motion, along the first and last
/// part.
glm::vec3 velocity_at(const std::vector<Keyframe>& keys, std::size_t i) {
  const Keyframe &before = keys[i == 0 ? 0 : i - 1], &after = keys[std::min(i + 1, keys.size() - 1)];
  return (after.position - before.position) / float(after.time_s - before.time_s);
}

glm::vec3 hermite(const std::vector<Keyframe>& keys, std::size_t i, float share) {
  const float length_s = float(keys[i + 1].time_s - keys[i].time_s);
  const float s2 = share * share, s3 = s2 * share;
  return (2 * s3 - 3 * s2 + 1) * keys[i].position + (s3 - 2 * s2 + share) * length_s * velocity_at(keys, i) +
         (3 * s2 - 2 * s3) * keys[i + 1].position + (s3 - s2) * length_s * velocity_at(keys, i + 1);
}

float turned(float from, float to, float share) {
  return from + share * std::remainder(to - from, glm::two_pi<float>());
}

}  // namespace

Keyframe between(const std::vector<Keyframe>& keys, double time_s, bool is_smooth) {
  if (time_s <= keys.front().time_s) return keys.front();
  if (time_s >= keys.back().time_s) return keys.back();
  const std::size_t i = segment_at(keys, time_s);
  const Keyframe &a = keys[i], &b = keys[i + 1];
  const float share = float((time_s - a.time_s) / (b.time_s - a.time_s));
  return {time_s, is_smooth ? hermite(keys, i, share) : glm::mix(a.position, b.position, share),
          turned(a.heading, b.heading, share), turned(a.pitch, b.pitch, share),
          glm::mix(a.field_of_view, b.field_of_view, share)};
}

glm::vec3 direction_at(const std::vector<Keyframe>& keys, double time_s, bool is_smooth) {
  const double first = keys.front().time_s, last = keys.back().time_s;
  if (keys.size() < 2) return glm::vec3(0.0f);
  const double from = std::clamp(time_s, first, last - tangent_step_s);
  const glm::vec3 step =
      between(keys, from + tangent_step_s, is_smooth).position - between(keys, from, is_smooth).position;
  if (glm::length(step) > 1e-7f) return glm::normalize(step);
  // It rests: as when it came to rest.
  for (std::size_t i = segment_at(keys, time_s) + 1; i-- > 0;)
    if (const glm::vec3 part = keys[i + 1].position - keys[i].position; glm::length(part) > 1e-4f)
      return glm::normalize(part);
  return glm::vec3(0.0f);
}

}  // namespace parvis::action
