// Right-handed axes about a normal.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace parvis::reference {

/// Duff et al. 2017, Building an Orthonormal Basis, Revisited.
struct Frame {
  glm::vec3 normal, tangent, bitangent;

  explicit Frame(glm::vec3 n) : normal(n) {
    const float sign = std::copysign(1.0f, n.z), a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    tangent = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    bitangent = {b, sign + n.y * n.y * a, -n.y};
  }

  glm::vec3 in_world(glm::vec3 v) const { return v.x * tangent + v.y * bitangent + v.z * normal; }
  glm::vec3 from_world(glm::vec3 v) const {
    return {glm::dot(v, tangent), glm::dot(v, bitangent), glm::dot(v, normal)};
  }
};

}  // namespace parvis::reference
