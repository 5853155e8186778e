// A model as a car stands: metres, x forward, y left, z up.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/bounds.h"
#include "scene/data/model.h"

namespace parvis::car_bodies {

/// The triangles of a model in the frame of a car, at rest. `model` must outlive it.
class Body {
 public:
  explicit Body(const scene::Model& model, const glm::mat4& car_from_model = glm::mat4(1.0f));
  Body(scene::Model&&, const glm::mat4&) = delete;
  explicit Body(scene::Model&&) = delete;

  const scene::Model& model() const { return model_; }
  const Bounds& bounds() const { return bounds_; }  ///< of what triangles use
  /// Place of the plane about which the sides are alike; mirrors and aerials on one side count for nothing.
  float middle_y() const { return middle_y_; }
  /// car_from_node of a part's node.
  const glm::mat4& car_from_part(std::size_t part) const { return pose_[std::size_t(part_of(part).node)]; }
  /// Corners of a triangle.
  std::array<glm::vec3, 3> corners(std::size_t part, std::size_t triangle) const;

 private:
  const scene::Part& part_of(std::size_t part) const { return model_.parts[part]; }

  const scene::Model& model_;
  std::vector<glm::mat4> pose_;
  Bounds bounds_;
  float middle_y_ = 0.0f;
};

/// Calls `visit(point)` for points all over a triangle that lie `step` apart or closer; coarser on a triangle
/// of more than `max_steps` steps, so that no file takes long.
template <class Visit>
void visit_points(const std::array<glm::vec3, 3>& corners, float step, const Visit& visit) {
  constexpr float max_steps = 500.0f;
  const glm::vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
  const float longest = std::max({glm::length(u), glm::length(v), glm::length(v - u)});
  const int steps = int(glm::clamp(std::ceil(longest / step), 1.0f, max_steps));
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j)
      visit(corners[0] + u * (float(i) / float(steps)) + v * (float(j) / float(steps)));
}

}  // namespace parvis::car_bodies
