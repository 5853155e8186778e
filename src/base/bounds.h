// Axis-aligned boxes.
#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace parvis {

struct Bounds {
  glm::vec3 min{std::numeric_limits<float>::max()};
  glm::vec3 max{std::numeric_limits<float>::lowest()};

  bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  glm::vec3 centre() const { return 0.5f * (min + max); }
  glm::vec3 size() const { return max - min; }
  float radius() const { return 0.5f * glm::length(size()); }  ///< of the sphere through the corners
  void add(glm::vec3 point) { min = glm::min(min, point), max = glm::max(max, point); }
  void add(const Bounds& other) { min = glm::min(min, other.min), max = glm::max(max, other.max); }
};

/// The box around a transformed box.
inline Bounds transformed(const glm::mat4& to_from, const Bounds& bounds) {
  Bounds result;
  if (bounds.empty()) return result;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p(corner & 1 ? bounds.max.x : bounds.min.x, corner & 2 ? bounds.max.y : bounds.min.y,
                      corner & 4 ? bounds.max.z : bounds.min.z);
    result.add(glm::vec3(to_from * glm::vec4(p, 1.0f)));
  }
  return result;
}

}  // namespace parvis
