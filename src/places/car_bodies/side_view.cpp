#include "places/car_bodies/side_view.h"

#include <algorithm>
#include <cmath>

namespace parvis::car_bodies {

SideView::SideView(const scene::Model& model) : bounds_(scene::bounds(model)) {
  columns_ = int(bounds_.size().x / cell_m) + 1;
  rows_ = int(bounds_.size().z / cell_m) + 1;
  depths_.assign(std::size_t(columns_) * std::size_t(rows_), nothing);
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  for (const scene::Part& part : model.parts)
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      glm::vec3 corners[3];
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = glm::vec3(pose[std::size_t(part.node)] *
                               glm::vec4(part.mesh.positions[part.mesh.indices[i + k]], 1.0f));
      add(corners);
    }
}

/// Rasterises a triangle at the middles of cells.
void SideView::add(const glm::vec3 (&corners)[3]) {
  const float middle_y = bounds_.centre().y;
  glm::vec2 at[3];
  float out[3];
  for (int k = 0; k < 3; ++k) {
    at[k] = glm::vec2(corners[k].x - bounds_.min.x, corners[k].z - bounds_.min.z) / cell_m - 0.5f;
    out[k] = std::abs(corners[k].y - middle_y);
  }
  const auto cross = [](glm::vec2 a, glm::vec2 b) { return a.x * b.y - a.y * b.x; };
  const float area = cross(at[1] - at[0], at[2] - at[0]);
  if (!(std::abs(area) > 1e-9f)) return;
  const glm::vec2 low = glm::min(at[0], glm::min(at[1], at[2])),
                  high = glm::max(at[0], glm::max(at[1], at[2]));
  for (int row = std::max(0, int(std::ceil(low.y))); row <= std::min(rows_ - 1, int(high.y)); ++row)
    for (int column = std::max(0, int(std::ceil(low.x))); column <= std::min(columns_ - 1, int(high.x));
         ++column) {
      const glm::vec2 here{float(column), float(row)};
      const float u = cross(at[1] - here, at[2] - here) / area, v = cross(at[2] - here, at[0] - here) / area;
      if (u < 0.0f || v < 0.0f || u + v > 1.0f) continue;
      float& depth = depths_[std::size_t(row * columns_ + column)];
      depth = std::max(depth, u * out[0] + v * out[1] + (1.0f - u - v) * out[2]);
    }
}

}  // namespace parvis::car_bodies
