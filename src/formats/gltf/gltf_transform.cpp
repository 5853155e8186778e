#include "formats/gltf/gltf_transform.h"

#include <algorithm>
#include <cmath>

namespace parvis::scene {
namespace {

/// A unit vector at right angles to another one.
glm::dvec3 beside(glm::dvec3 axis) {
  const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(axis, other));
}

}  // namespace

bool decompose(const glm::dmat4& matrix, ModelNode& node) {
  constexpr double max_cosine = 1e-3;  // matrices are written with few digits
  node.translation = glm::dvec3(matrix[3]);
  glm::dvec3 axes[3];
  bool is_flat[3];
  for (int i = 0; i < 3; ++i) {
    node.scale[i] = glm::length(glm::dvec3(matrix[i]));
    is_flat[i] = !(node.scale[i] > 0.0);
    axes[i] = is_flat[i] ? glm::dvec3(0.0) : glm::dvec3(matrix[i]) / node.scale[i];
  }
  for (int i = 0; i < 3; ++i) {  // an axis without length points where the others leave room
    if (!is_flat[i]) continue;
    const glm::dvec3 b = axes[(i + 1) % 3], c = axes[(i + 2) % 3];
    const glm::dvec3 across = glm::cross(b, c);
    const glm::dvec3 known = glm::length(b) > 0.5 ? b : c;
    axes[i] = glm::length(across) > max_cosine ? glm::normalize(across)
              : glm::length(known) > 0.5       ? beside(known)
                                               : glm::dvec3(i == 0, i == 1, i == 2);
  }
  double skew = 0.0;
  for (int i = 0; i < 3; ++i) skew = std::max(skew, std::abs(glm::dot(axes[i], axes[(i + 1) % 3])));
  if (glm::dot(glm::cross(axes[0], axes[1]), axes[2]) < 0.0) axes[0] = -axes[0], node.scale.x = -node.scale.x;
  glm::dvec3 across = glm::cross(axes[0], axes[1]);
  across = glm::length(across) > max_cosine ? glm::normalize(across) : beside(axes[0]);
  node.rotation = glm::normalize(
      glm::quat_cast(glm::dmat3(axes[0], glm::normalize(glm::cross(across, axes[0])), across)));
  return skew < max_cosine;
}

glm::dmat4 z_up_from_y_up() {
  return {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.0, -1.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
}

nlohmann::json gltf_matrix(const glm::dmat4& matrix) {
  nlohmann::json numbers = nlohmann::json::array();
  for (int i = 0; i < 16; ++i) numbers.push_back(matrix[i / 4][i % 4]);
  return numbers;
}

}  // namespace parvis::scene
