#include "graphics/shading/heightfield.h"

#include <algorithm>
#include <cmath>

namespace parvis::shading {

Heightfield::Heightfield(const Bounds& bounds, float cell_m, int max_cells_per_side) : bounds_(bounds) {
  if (bounds.empty()) return;
  const glm::vec3 size = bounds.size();
  cell_m_ = std::max(cell_m, std::max(size.x, size.y) / float(max_cells_per_side));
  heights_ = ImageF(int(size.x / cell_m_) + 1, int(size.y / cell_m_) + 1, 1, bounds.min.z);
}

/// The cells that a box touches, seen from above; those at the rim where it lies outside.
Heightfield::Cells Heightfield::cells_of(const Bounds& box) const {
  const auto cell = [&](float metres, float origin, int count) {
    return int(std::clamp((metres - origin) / cell_m_, 0.0f, float(count - 1)));
  };
  return {{cell(box.min.x, bounds_.min.x, heights_.width), cell(box.min.y, bounds_.min.y, heights_.height)},
          {cell(box.max.x, bounds_.min.x, heights_.width), cell(box.max.y, bounds_.min.y, heights_.height)}};
}

void Heightfield::clear(const Bounds& region) {
  if (heights_.empty() || region.max.x < bounds_.min.x || region.min.x > bounds_.max.x ||
      region.max.y < bounds_.min.y || region.min.y > bounds_.max.y)
    return;
  const Cells cells = cells_of(region);
  for (int y = cells.first.y; y <= cells.last.y; ++y)
    std::fill(heights_.at(cells.first.x, y), heights_.at(cells.last.x, y) + 1, bounds_.min.z);
}

void Heightfield::add(const Mesh& mesh, const glm::mat4& world_from_mesh, const Bounds* region) {
  if (heights_.empty()) return;
  const Cells allowed = cells_of(region ? *region : bounds_);
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    glm::vec3 corners[3];
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = world_from_mesh * glm::vec4(mesh.positions[mesh.indices[i + k]], 1.0f);
    add_triangle(corners, allowed);
  }
}

void Heightfield::add_triangle(const glm::vec3 (&corners)[3], const Cells& allowed) {
  const Cells touched = cells_of({glm::min(glm::min(corners[0], corners[1]), corners[2]),
                                  glm::max(glm::max(corners[0], corners[1]), corners[2])});
  const glm::ivec2 first = glm::max(touched.first, allowed.first),
                   last = glm::min(touched.last, allowed.last);
  if (first.x > last.x || first.y > last.y) return;
  const glm::vec2 ab(corners[1] - corners[0]), ac(corners[2] - corners[0]);
  const float twice_area = ab.x * ac.y - ac.x * ab.y;
  if (std::abs(twice_area) < 1e-6f) return;  // upright: the roof above it counts
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) {
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
