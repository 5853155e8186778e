// Triangles of a simple polygon without holes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <numeric>
#include <vector>

#include "base/plan_polygon.h"

namespace parvis::scene {

/// The polygon's corners in plan, counter-clockwise: the coordinate along which its normal (Newell's) is
/// longest is left out, so that what lay on a line lies on one, to the last digit.
inline std::vector<glm::dvec2> corners_in_plan(const std::vector<glm::dvec3>& corners) {
  glm::dvec3 normal(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  const glm::dvec3 size = glm::abs(normal);
  const int left_out = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  const int first = (left_out + 1) % 3, second = (left_out + 2) % 3;
  std::vector<glm::dvec2> plan;
  for (const glm::dvec3& corner : corners)
    plan.emplace_back(normal[left_out] < 0.0 ? -corner[first] : corner[first], corner[second]);
  return plan;
}

/// True where the polygon turns right at a corner.
inline bool is_concave(const std::vector<glm::dvec2>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (twice_area(corners[i], corners[(i + 1) % corners.size()], corners[(i + 2) % corners.size()]) < 0.0)
      return true;
  return false;
}

/// Triangles of a polygon that runs counter-clockwise, as indices of its corners (Meisters 1975: Polygons
/// have ears). A corner that lies on the side of an ear, as that of an even L does, keeps it from being cut.
/// The triangles of a polygon that crosses itself cover more than its inside.
inline std::vector<std::array<std::uint32_t, 3>> ears(const std::vector<glm::dvec2>& corners) {
  std::vector<std::uint32_t> left(corners.size());
  std::iota(left.begin(), left.end(), 0u);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const auto triangle_at = [&](std::size_t i) {
    return std::array{left[(i + left.size() - 1) % left.size()], left[i], left[(i + 1) % left.size()]};
  };
  const auto area_at = [&](std::size_t i) {
    const auto [a, b, c] = triangle_at(i);
    return twice_area(corners[a], corners[b], corners[c]);
  };
  const auto is_ear = [&](std::size_t i) {
    const auto [a, b, c] = triangle_at(i);
    if (!(area_at(i) > 0.0)) return false;
    const std::array ear{corners[a], corners[b], corners[c]};
    return std::ranges::none_of(left, [&](std::uint32_t other) {
      return std::ranges::find(ear, corners[other]) == ear.end() && is_in_triangle(ear, corners[other]);
    });
  };
  while (left.size() > 3) {
    std::size_t at = 0;
    while (at < left.size() && !is_ear(at)) ++at;
    if (at == left.size()) {  // it crosses itself, or what is left is flat: the widest corner goes
      at = 0;
      for (std::size_t i = 1; i < left.size(); ++i)
        if (area_at(i) > area_at(at)) at = i;
    }
    if (area_at(at) != 0.0) triangles.push_back(triangle_at(at));
    left.erase(left.begin() + std::ptrdiff_t(at));
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace parvis::scene
