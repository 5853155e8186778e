#include "scene/data/crown_openness.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parvis::scene {
namespace {

constexpr int cells_per_side = 24;
constexpr float min_openness = 0.08f;

/// Directions over the upper hemisphere, in rings.
const std::array<glm::vec3, 13>& directions() {
  static const std::array<glm::vec3, 13> all = [] {
    std::array<glm::vec3, 13> result{};
    result[0] = {0, 0, 1};
    for (int i = 0; i < 12; ++i) {
      const float up = i < 6 ? 0.7f : 0.3f, turn = 1.04719755f * (float(i) + (i < 6 ? 0.0f : 0.5f));
      const float across = std::sqrt(1.0f - up * up);
      result[std::size_t(i) + 1] = {across * std::cos(turn), across * std::sin(turn), up};
    }
    return result;
  }();
  return all;
}

}  // namespace

CrownOpenness::CrownOpenness(std::span<const LeafArea> leaves) {
  for (const LeafArea& leaf : leaves) box_.add(leaf.place);
  if (leaves.empty()) return;
  const glm::vec3 size = box_.size();
  cell_m_ = std::max(std::max({size.x, size.y, size.z}) / float(cells_per_side), 1e-3f);
  cells_ = glm::ivec3(size / cell_m_) + 1;
  depth_of_cell_.assign(std::size_t(cells_.x) * std::size_t(cells_.y) * std::size_t(cells_.z), 0.0f);
  const float per_cell = 0.5f / (cell_m_ * cell_m_);  // extinction times the cell's side
  for (const LeafArea& leaf : leaves) {
    const glm::ivec3 cell = glm::min(glm::ivec3((leaf.place - box_.min) / cell_m_), cells_ - 1);
    depth_of_cell_[index(cell)] += leaf.area_m2 * per_cell;
  }
}

std::size_t CrownOpenness::index(glm::ivec3 cell) const {
  return (std::size_t(cell.z) * std::size_t(cells_.y) + std::size_t(cell.y)) * std::size_t(cells_.x) +
         std::size_t(cell.x);
}

float CrownOpenness::depth(glm::vec3 place, glm::vec3 direction, float enough) const {
  const glm::vec3 start = (place - box_.min) / cell_m_,
                  end(cells_.x, cells_.y, (box_.max.z - box_.min.z) / cell_m_);
  float exit = 2.0f * float(cells_per_side);  // steps along the ray, in the middle of cells of its own
  for (int axis = 0; axis < 3; ++axis)
    if (direction[axis] != 0.0f)
      exit = std::min(exit, ((direction[axis] > 0.0f ? end[axis] : 0.0f) - start[axis]) / direction[axis]);
  float depth = 0.0f;
  for (float along = 0.5f; along <= exit && depth < enough; along += 1.0f) {
    const glm::ivec3 cell = glm::ivec3(start + along * direction + 1.0f) - 1;  // floor, from -1 on
    if (glm::all(glm::lessThan(glm::uvec3(cell), glm::uvec3(cells_)))) depth += depth_of_cell_[index(cell)];
  }
  return std::min(depth, enough);
}

float CrownOpenness::at(glm::vec3 place) const {
  constexpr float dark = 4.0f;
  if (depth_of_cell_.empty()) return 1.0f;
  float seen = 0.0f, all = 0.0f;
  for (const glm::vec3 direction : directions()) {
    const float weight = 0.3f + direction.z;
    seen += weight * std::exp(-depth(place, direction, dark)), all += weight;
  }
  return std::max(seen / all, min_openness);
}

float CrownOpenness::max_seen(glm::vec3 place) const {
  constexpr float dark = 8.0f;
  if (depth_of_cell_.empty()) return 1.0f;
  float lowest = dark;
  for (const glm::vec3 up : directions())
    for (const glm::vec3 direction : {up, -up}) lowest = depth(place, direction, lowest);
  return std::exp(-lowest);
}

}  // namespace parvis::scene
