#include "graphics/light/disc_patterns.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace parvis::light {
namespace {

/// A number in [0, 1), another for each `value` (PCG's output function, O'Neill 2014).
float scrambled(std::uint32_t value) {
  value = value * 747796405u + 2891336453u;
  value = ((value >> ((value >> 28) + 4)) ^ value) * 277803737u;
  return float((value >> 22 ^ value) >> 8) * 0x1p-24f;
}

/// Points of the R2 sequence (Roberts 2018), moved for each pattern (Cranley and Patterson 1976).
glm::vec2 low_discrepancy(int index, glm::vec2 shift) {
  const glm::dvec2 step(0.7548776662466927, 0.5698402909980532);
  return glm::vec2(glm::fract(glm::dvec2(shift) + double(index) * step));
}

/// Even over the unit disc (Shirley and Chiu 1997).
glm::vec2 on_disc(glm::vec2 u) {
  const glm::vec2 p = 2.0f * u - 1.0f;
  if (p.x == 0.0f && p.y == 0.0f) return p;
  const bool is_wide = std::abs(p.x) > std::abs(p.y);
  const float radius = is_wide ? p.x : p.y;
  const float angle = is_wide ? 0.785398163f * p.y / p.x : 1.570796327f - 0.785398163f * p.x / p.y;
  return radius * glm::vec2(std::cos(angle), std::sin(angle));
}

void sort_by_angle(std::span<DiscPoint> points) {
  std::ranges::sort(points, {}, [](const DiscPoint& p) { return std::atan2(p.at.y, p.at.x); });
}

}  // namespace

DiscPatterns::DiscPatterns(int first, int count)
    : count_(std::size_t(count)), bounces_(std::size_t(bounces_of(first + count) - bounces_of(first))) {
  points_.reserve(pattern_count * count_);
  std::vector<DiscPoint> others;
  others.reserve(count_);
  for (std::size_t pattern = 0; pattern < pattern_count; ++pattern) {
    const glm::vec2 shift(scrambled(std::uint32_t(2 * pattern)), scrambled(std::uint32_t(2 * pattern + 1)));
    others.clear();
    for (int i = first; i < first + count; ++i)
      (brings_bounce(i) ? points_ : others).push_back({on_disc(low_discrepancy(i, shift)), i});
    sort_by_angle(std::span(points_).last(bounces_));
    sort_by_angle(others);
    points_.insert(points_.end(), others.begin(), others.end());
  }
}

reference::Frame turned_frame(glm::vec3 normal, std::size_t vertex) {
  reference::Frame frame(normal);
  const float turn = 6.2831853f * scrambled(std::uint32_t(vertex / vertices_per_turn)), c = std::cos(turn),
              s = std::sin(turn);
  const glm::vec3 tangent = c * frame.tangent + s * frame.bitangent;
  frame.bitangent = c * frame.bitangent - s * frame.tangent;
  frame.tangent = tangent;
  return frame;
}

}  // namespace parvis::light
