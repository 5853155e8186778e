#include "curved_reflectors/virtual_grid.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "base/bounds.h"

namespace parvis::curved_reflectors {
namespace {

constexpr int halvings = 24;       // of the search for the cells' size
constexpr int most_a_side = 1000;  // cells: their numbers fit into a key
constexpr float pixels_a_corner = 64.0f;

struct Layout {
  glm::vec3 origin, cell;  ///< cell: its edges
  glm::ivec3 count;

  glm::ivec3 cell_of(glm::vec3 vertex) const {
    return glm::clamp(glm::ivec3(glm::floor((vertex - origin) / cell)), glm::ivec3(0), count - 1);
  }
};

/// Cells of about `edge`, stretched so that a whole number fills the box; a flat box has one layer of them.
Layout layout_of(const Bounds& box, float edge) {
  const glm::vec3 size = glm::max(box.size(), glm::vec3(1e-6f));
  const glm::ivec3 count =
      glm::clamp(glm::ivec3(glm::round(size / edge)), glm::ivec3(1), glm::ivec3(most_a_side));
  return {box.min, size / glm::vec3(count), count};
}

std::uint32_t key_of(glm::ivec3 p) {
  return (std::uint32_t(p.z) << 20) | (std::uint32_t(p.y) << 10) | std::uint32_t(p.x);
}

glm::ivec3 corner_of(glm::ivec3 cell, int corner) {
  return cell + glm::ivec3(corner & 1, (corner >> 1) & 1, corner >> 2);
}

std::size_t count_corners(const Layout& layout, std::span<const glm::vec3> vertices) {
  std::unordered_set<std::uint32_t> cells, corners;
  for (const glm::vec3& vertex : vertices) {
    const glm::ivec3 cell = layout.cell_of(vertex);
    if (!cells.insert(key_of(cell)).second) continue;
    for (int corner = 0; corner < 8; ++corner) corners.insert(key_of(corner_of(cell, corner)));
  }
  return corners.size();
}

/// The finest cells whose corners are no more than wanted.
Layout choose_layout(std::span<const glm::vec3> vertices, float share) {
  Bounds box;
  for (const glm::vec3& vertex : vertices) box.add(vertex);
  const glm::vec3 size = glm::max(box.size(), glm::vec3(1e-6f));
  float coarse = 2.0f * std::max({size.x, size.y, size.z}), fine = coarse / float(most_a_side);
  const auto wanted = std::size_t(share * float(vertices.size()));
  for (int i = 0; i < halvings; ++i) {
    const float edge = std::sqrt(coarse * fine);
    (count_corners(layout_of(box, edge), vertices) <= wanted ? coarse : fine) = edge;
  }
  return layout_of(box, coarse);
}

}  // namespace

VirtualGrid::VirtualGrid(std::span<const glm::vec3> vertices, float share) {
  if (vertices.empty()) return;
  const Layout layout = choose_layout(vertices, share);
  std::unordered_map<std::uint32_t, std::uint32_t> cell_numbers, corner_numbers;
  for (const glm::vec3& vertex : vertices) {
    const glm::ivec3 cell = layout.cell_of(vertex);
    const auto [number, is_new] = cell_numbers.try_emplace(key_of(cell), std::uint32_t(cells_.size()));
    if (is_new) {
      cells_.emplace_back();
      for (int i = 0; i < 8; ++i) {
        const glm::ivec3 corner = corner_of(cell, i);
        const auto [place, is_first] =
            corner_numbers.try_emplace(key_of(corner), std::uint32_t(corners_.size()));
        if (is_first) corners_.push_back(layout.origin + glm::vec3(corner) * layout.cell);
        cells_.back()[std::size_t(i)] = place->second;
      }
    }
    places_.push_back({number->second, (vertex - layout.origin) / layout.cell - glm::vec3(cell)});
  }
}

void VirtualGrid::interpolate(std::span<const VirtualPoint> corners, std::span<VirtualPoint> vertices) const {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    const std::array<std::uint32_t, 8>& cell = cells_[place.cell];
    VirtualPoint sum;
    for (int corner = 0; corner < 8; ++corner) {
      const VirtualPoint& at = corners[cell[std::size_t(corner)]];
      const glm::vec3 weights =
          glm::mix(1.0f - place.share, place.share, glm::vec3(corner_of(glm::ivec3(0), corner)));
      sum.position += weights.x * weights.y * weights.z * at.position;
      sum.is_lost = sum.is_lost || at.is_lost;
    }
    vertices[i] = sum;
  }
}

VirtualGridLevels::VirtualGridLevels(std::span<const glm::vec3> vertices) : vertex_count_(vertices.size()) {
  for (const float share : shares) grids_.emplace_back(vertices, share);
}

const VirtualGrid* VirtualGridLevels::grid_for(float area_px) const {
  const float wanted = area_px / pixels_a_corner;
  if (wanted > float(vertex_count_)) return nullptr;
  for (std::size_t i = grids_.size(); i-- > 0;)
    if (float(grids_[i].corners().size()) >= wanted) return &grids_[i];
  return &grids_.front();
}

}  // namespace parvis::curved_reflectors
