#include "formats/gltf/gltf_transform.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parvis::scene {
namespace {

/// A unit vector at right angles to another one.
glm::dvec3 beside(glm::dvec3 axis) {
  const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(axis, other));
}

}  // namespace

bool decompose(const glm::dmat4& matrix, ModelNode& node) {
  constexpr double max_cosine = 1e-3;  // of axes that point the same way, where one of them has no length
  constexpr double max_skew = 1e-5;    // 1 mm at 100 m; rounding to single precision leaves 1e-7
  constexpr double rounding = 1e-14;   // an axis that is shorter beside the others points anywhere
  node.translation = glm::dvec3(matrix[3]);
  glm::dvec3 axes[3];
  bool is_flat[3];
  for (int i = 0; i < 3; ++i) node.scale[i] = glm::length(glm::dvec3(matrix[i]));
  const double largest = std::max({node.scale.x, node.scale.y, node.scale.z});
  for (int i = 0; i < 3; ++i) {
    is_flat[i] = !(node.scale[i] > rounding * largest);
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
  return skew < max_skew;
}

void decompose(const glm::dmat4& matrix, ModelNode& upper, ModelNode& lower) {
  constexpr int max_sweeps = 30;  // converges quadratically: some five are needed
  constexpr double max_cosine = 1e-15;
  glm::dmat4 turned = matrix;  // by `turn`, until its axes stand at right angles (Hestenes 1958)
  glm::dmat3 turn(1.0);
  bool is_done = false;
  for (int sweep = 0; sweep < max_sweeps && !is_done; ++sweep) {
    is_done = true;
    for (const auto& [i, j] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
      const glm::dvec3 a(turned[i]), b(turned[j]);
      const double c = glm::dot(a, b);
      if (!(std::abs(c) > max_cosine * glm::length(a) * glm::length(b))) continue;
      is_done = false;
      const double half = (glm::dot(b, b) - glm::dot(a, a)) / (2.0 * c);
      const double t = (half < 0.0 ? -1.0 : 1.0) / (std::abs(half) + std::sqrt(1.0 + half * half));
      const double cosine = 1.0 / std::sqrt(1.0 + t * t), sine = cosine * t;
      turned[i] = glm::dvec4(cosine * a - sine * b, 0.0), turned[j] = glm::dvec4(sine * a + cosine * b, 0.0);
      const glm::dvec3 of_i = turn[i], of_j = turn[j];
      turn[i] = cosine * of_i - sine * of_j, turn[j] = sine * of_i + cosine * of_j;
    }
  }
  decompose(turned, upper);
  lower.translation = glm::dvec3(0.0);
  lower.rotation = glm::normalize(glm::quat_cast(glm::transpose(turn)));
  lower.scale = glm::dvec3(1.0);
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
