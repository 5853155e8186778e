// How far feet slide: for the tests of this room, and for the bench of crowds.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "life/people/walking_body.h"

namespace parvis::people {

/// Places of heel and ball of both feet, in the world.
inline std::array<glm::vec3, 4> contact_points(const BodyField& body, const Lead& lead,
                                               const Posture& posture) {
  const Skeleton& k = body.skeleton();
  const std::vector<glm::mat4> pose = pose_of(k, posture);
  const glm::mat4 world =
      glm::rotate(glm::translate(glm::mat4(1.0f), lead.place), lead.heading, glm::vec3(0, 0, 1));
  std::array<glm::vec3, 4> points;
  for (const int side : {0, 1}) {
    const int foot = side == 0 ? left_foot : right_foot;
    const glm::mat4 m = world * pose[std::size_t(foot) + 1];
    const float z = -body.shape().ankle_z;
    points[std::size_t(2 * side)] = glm::vec3(m * glm::vec4(k.heel_x, 0.0f, z, 1.0f));
    points[std::size_t(2 * side + 1)] =
        glm::vec3(m * glm::vec4(k.ball_x - k.joint[std::size_t(foot)].x, 0.0f, z, 1.0f));
  }
  return points;
}

/// How far points on the ground have moved since they came to it; the 99th percentile over frames, metres.
class SlideMeter {
 public:
  /// Adds a frame.
  void add(const std::array<glm::vec3, 4>& points) {
    constexpr float on_ground_m = 0.008f;
    for (std::size_t i = 0; i < 4; ++i) {
      if (points[i].z > on_ground_m) {
        since_[i].reset();
        continue;
      }
      if (!since_[i]) since_[i] = points[i];
      slides_.push_back(glm::distance(glm::vec2(*since_[i]), glm::vec2(points[i])));
      lowest_ = std::min(lowest_, points[i].z);
    }
  }
  /// The 99th percentile so far; 1e9 where no foot has come to the ground.
  float slide_m() {
    std::ranges::sort(slides_);
    return slides_.empty() ? 1e9f : slides_[slides_.size() * 99 / 100];
  }
  /// The lowest height of a point that was on the ground.
  float lowest() const { return lowest_; }

 private:
  std::array<std::optional<glm::vec3>, 4> since_;
  std::vector<float> slides_;
  float lowest_ = 0.0f;
};

}  // namespace parvis::people
