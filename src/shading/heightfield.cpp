#include "shading/heightfield.h"

#include <algorithm>
#include <cmath>

namespace parvis::shading {

Heightfield::Heightfield(const Bounds& bounds, float cell_m, int most_cells_a_side) : bounds_(bounds) {
  if (bounds.empty()) return;
  const glm::vec3 size = bounds.size();
  cell_m_ = std::max(cell_m, std::max(size.x, size.y) / float(most_cells_a_side));
  heights_ = ImageF(int(size.x / cell_m_) + 1, int(size.y / cell_m_) + 1, 1, bounds.min.z);
}

void Heightfield::add(const Mesh& mesh, const glm::mat4& world_from_mesh) {
  if (heights_.empty()) return;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    glm::vec3 corners[3];
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = world_from_mesh * glm::vec4(mesh.positions[mesh.indices[i + k]], 1.0f);
    add_triangle(corners);
  }
}

void Heightfield::add_triangle(const glm::vec3 (&corners)[3]) {
  const auto cell_of = [&](float metres, float origin, int count) {
    return int(std::clamp((metres - origin) / cell_m_, 0.0f, float(count - 1)));
  };
  const auto [west, east] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [south, north] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  const glm::vec2 ab(corners[1] - corners[0]), ac(corners[2] - corners[0]);
  const float twice_area = ab.x * ac.y - ac.x * ab.y;
  if (std::abs(twice_area) < 1e-6f) return;  // upright: the roof above it counts
  for (int y = cell_of(south, bounds_.min.y, heights_.height);
       y <= cell_of(north, bounds_.min.y, heights_.height); ++y)
    for (int x = cell_of(west, bounds_.min.x, heights_.width);
         x <= cell_of(east, bounds_.min.x, heights_.width); ++x) {
      const glm::vec2 p = glm::vec2(bounds_.min) + cell_m_ * (glm::vec2(x, y) + 0.5f) - glm::vec2(corners[0]);
      const float b = (p.x * ac.y - ac.x * p.y) / twice_area, c = (ab.x * p.y - p.x * ab.y) / twice_area;
      if (b < 0.0f || c < 0.0f || b + c > 1.0f) continue;
      const float height =
          corners[0].z + b * (corners[1].z - corners[0].z) + c * (corners[2].z - corners[0].z);
      *heights_.at(x, y) = std::max(*heights_.at(x, y), height);
    }
}

float Heightfield::height_m(glm::vec2 position) const {
  const glm::vec2 p = (position - glm::vec2(bounds_.min)) / cell_m_;
  if (p.x < 0.0f || p.y < 0.0f || p.x >= float(heights_.width) || p.y >= float(heights_.height))
    return bounds_.min.z;
  return *heights_.at(int(p.x), int(p.y));
}

}  // namespace parvis::shading
