#include "life/crowd/walls.h"

#include <algorithm>
#include <cmath>

namespace parvis::crowd {
namespace {

constexpr float min_cell_m = 2.0f;
constexpr int max_wall_cells_per_side = 2048;

bool segments_cross(glm::vec2 a, glm::vec2 b, glm::vec2 c, glm::vec2 d) {
  const auto side = [](glm::vec2 p, glm::vec2 q, glm::vec2 r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  };
  return side(a, b, c) * side(a, b, d) < 0.0f && side(c, d, a) * side(c, d, b) < 0.0f;
}

}  // namespace

glm::vec2 nearest_on_segment(glm::vec2 a, glm::vec2 b, glm::vec2 p) {
  const glm::vec2 along = b - a;
  const float length_2 = glm::dot(along, along);
  const float t = length_2 > 0.0f ? std::clamp(glm::dot(p - a, along) / length_2, 0.0f, 1.0f) : 0.0f;
  return a + t * along;
}

std::optional<WallContact> contact_with(const Wall& wall, glm::vec2 place) {
  const glm::vec2 along = wall.b - wall.a;
  const float length_2 = glm::dot(along, along), at = glm::dot(place - wall.a, along);
  if (at < 0.0f || at > length_2 || length_2 == 0.0f) return std::nullopt;
  const glm::vec2 inward = glm::vec2(-along.y, along.x) / std::sqrt(length_2);
  return WallContact{inward, glm::dot(place - wall.a, inward)};
}

Walls::Walls(std::vector<Wall> walls, float reach_m) : walls_(std::move(walls)) {
  if (walls_.empty()) return;
  glm::vec2 low(walls_[0].a), high(walls_[0].a);
  for (const Wall& wall : walls_)
    low = glm::min(low, glm::min(wall.a, wall.b)), high = glm::max(high, glm::max(wall.a, wall.b));
  low -= reach_m, high += reach_m;
  const glm::vec2 extent = high - low;
  cell_m_ = std::max(min_cell_m, std::max(extent.x, extent.y) / float(max_wall_cells_per_side));
  corner_ = low;
  size_ = glm::ivec2(glm::ceil(extent / cell_m_)) + 1;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  // cell, wall
  const float half_diagonal = 0.7072f * cell_m_;
  for (std::uint32_t w = 0; w < walls_.size(); ++w) {
    const Wall& wall = walls_[w];
    const glm::ivec2 first = cell_of(glm::min(wall.a, wall.b) - reach_m),
                     last = cell_of(glm::max(wall.a, wall.b) + reach_m);
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        const glm::vec2 middle = corner_ + (glm::vec2(x, y) + 0.5f) * cell_m_;
        if (glm::distance(nearest_on_segment(wall.a, wall.b, middle), middle) <= reach_m + half_diagonal)
          pairs.emplace_back(std::uint32_t(y * size_.x + x), w);
      }
  }
  starts_.assign(std::size_t(size_.x) * std::size_t(size_.y) + 1, 0);
  for (const auto& [cell, wall] : pairs) ++starts_[cell + 1];
  for (std::size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
  items_.resize(pairs.size());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (const auto& [cell, wall] : pairs) items_[next[cell]++] = wall;
}

glm::ivec2 Walls::cell_of(glm::vec2 place) const {
  return glm::clamp(glm::ivec2(glm::floor((place - corner_) / cell_m_)), glm::ivec2(0), size_ - 1);
}

std::span<const std::uint32_t> Walls::near(glm::vec2 place) const {
  if (walls_.empty()) return {};
  const glm::vec2 inside = (place - corner_) / cell_m_;
  if (!(inside.x >= 0.0f && inside.y >= 0.0f && inside.x < float(size_.x) && inside.y < float(size_.y)))
    return {};
  const auto cell = std::size_t(int(inside.y) * size_.x + int(inside.x));
  return {items_.data() + starts_[cell], items_.data() + starts_[cell + 1]};
}

bool Walls::crosses(glm::vec2 from, glm::vec2 to, float height_m) const {
  if (walls_.empty()) return false;
  const glm::ivec2 first = cell_of(glm::min(from, to)), last = cell_of(glm::max(from, to));
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) {
      const auto cell = std::size_t(y * size_.x + x);
      for (std::uint32_t i = starts_[cell]; i < starts_[cell + 1]; ++i) {
        const Wall& wall = walls_[items_[i]];
        if (height_m >= wall.bottom_m && height_m <= wall.top_m && segments_cross(from, to, wall.a, wall.b))
          return true;
      }
    }
  return false;
}

}  // namespace parvis::crowd
