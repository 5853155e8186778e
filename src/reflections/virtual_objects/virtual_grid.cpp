#include "reflections/virtual_objects/virtual_grid.h"

#include <algorithm>
#include <cmath>

#include "base/bounds.h"

namespace parvis::virtual_objects {
namespace {

constexpr int halvings = 16;                              // of the search for the cells' size
constexpr float finest = 1e-3f;                           // cells of the box's longest edge
constexpr std::size_t box_per_vertex = 4, min_box = 512;  // corners of the whole box, used or not
constexpr float pixels_per_corner = 64.0f;

/// Cells of about `edge`, stretched so that a whole number fills the box; a flat box has one layer of them.
GridLayout layout_of(const Bounds& box, float edge) {
  const glm::vec3 size = glm::max(box.size(), glm::vec3(1e-6f));
  const glm::ivec3 count =
      glm::clamp(glm::ivec3(glm::round(size / edge)), glm::ivec3(1), glm::ivec3(int(1.0f / finest)));
  return {box.min, size / glm::vec3(count), count};
}

glm::ivec3 corner_of(glm::ivec3 cell, int corner) {
  return cell + glm::ivec3(corner & 1, (corner >> 1) & 1, corner >> 2);
}

/// Calls `visit(corner, its number)` for each corner that a vertex needs, once. `numbers` is as
/// VirtualGrid::numbers_in_box.
template <class Visit>
void for_each_corner(const GridLayout& layout, std::span<const glm::vec3> vertices,
                     std::vector<std::uint32_t>& numbers, Visit&& visit) {
  numbers.assign(layout.box_size(), VirtualGrid::no_corner);
  std::uint32_t next = 0;
  for (const glm::vec3& vertex : vertices) {
    const glm::ivec3 cell = layout.cell_of(vertex);
    for (int i = 0; i < 8; ++i) {
      const glm::ivec3 corner = corner_of(cell, i);
      std::uint32_t& number = numbers[layout.place_in_box(corner)];
      if (number != VirtualGrid::no_corner) continue;
      visit(corner);
      number = next++;
    }
  }
}

/// The finest cells whose corners are no more than wanted.
GridLayout choose_layout(std::span<const glm::vec3> vertices, float share) {
  Bounds box;
  for (const glm::vec3& vertex : vertices) box.add(vertex);
  const glm::vec3 size = glm::max(box.size(), glm::vec3(1e-6f));
  float coarse = 2.0f * std::max({size.x, size.y, size.z}), fine = coarse * finest;
  const auto wanted = std::size_t(share * float(vertices.size()));
  std::vector<std::uint32_t> numbers;
  const auto is_coarse_enough = [&](const GridLayout& layout) {
    if (layout.box_size() > std::max(box_per_vertex * vertices.size(), min_box)) return false;
    std::size_t corners = 0;
    for_each_corner(layout, vertices, numbers, [&](glm::ivec3) { ++corners; });
    return corners <= wanted;
  };
  for (int i = 0; i < halvings; ++i) {
    const float edge = std::sqrt(coarse * fine);
    (is_coarse_enough(layout_of(box, edge)) ? coarse : fine) = edge;
  }
  return layout_of(box, coarse);
}

}  // namespace

VirtualGrid::VirtualGrid(std::span<const glm::vec3> vertices, float share) {
  if (vertices.empty()) return;
  layout_ = choose_layout(vertices, share);
  for_each_corner(layout_, vertices, numbers_, [&](glm::ivec3 corner) {
    corners_.push_back(layout_.origin + glm::vec3(corner) * layout_.cell);
  });
}

void VirtualGrid::interpolate(std::span<const glm::vec3> vertices, std::span<const VirtualPoint> corners,
                              std::span<VirtualPoint> shown) const {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const glm::ivec3 cell = layout_.cell_of(vertices[i]);
    const glm::vec3 part = layout_.place_of(vertices[i]) - glm::vec3(cell);
    VirtualPoint sum;
    for (int c = 0; c < 8; ++c) {
      const glm::ivec3 corner = corner_of(cell, c);
      const VirtualPoint& at = corners[numbers_[layout_.place_in_box(corner)]];
      const glm::vec3 weights = glm::mix(1.0f - part, part, glm::vec3(corner - cell));
      sum.position += weights.x * weights.y * weights.z * at.position;
      sum.is_lost = sum.is_lost || at.is_lost;
    }
    shown[i] = sum;
  }
}

std::optional<std::size_t> grid_level(std::span<const std::uint32_t> corner_counts, std::size_t vertex_count,
                                      float area_px) {
  const float wanted = area_px / pixels_per_corner;
  if (corner_counts.empty() || wanted > float(vertex_count)) return {};
  for (std::size_t i = corner_counts.size(); i-- > 0;)
    if (float(corner_counts[i]) >= wanted) return i;
  return 0;
}

}  // namespace parvis::virtual_objects
