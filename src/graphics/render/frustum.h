// The six planes of a view, and which boxes lie outside them.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "base/bounds.h"

namespace parvis::render {

/// Planes (normal inward, offset) of a clip matrix (Gribb and Hartmann 2001).
class Frustum {
 public:
  explicit Frustum(const glm::mat4& clip_from_world) {
    const glm::mat4 rows = glm::transpose(clip_from_world);
    planes_ = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
               rows[3] - rows[1], rows[3] + rows[2], rows[3] - rows[2]};
  }

  /// False only where the whole box lies outside one plane: a few boxes near corners pass that could not be
  /// seen.
  bool may_see(const Bounds& box) const {
    if (box.empty()) return false;
    const glm::vec3 centre = box.centre(), half = 0.5f * box.size();
    for (const glm::vec4& plane : planes_) {
      const glm::vec3 normal(plane);
      if (glm::dot(normal, centre) + plane.w + glm::dot(glm::abs(normal), half) < -slack_m) return false;
    }
    return true;
  }

 private:
  static constexpr float slack_m = 1e-3f;  // rounding must not cut off what touches a plane

  std::array<glm::vec4, 6> planes_;
};

}  // namespace parvis::render
