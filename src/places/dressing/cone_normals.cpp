#include "places/dressing/cone_normals.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace parvis::dressing {
namespace {

constexpr std::size_t min_sides = 12, max_sides = 500;  // of more sides, none is seen
constexpr float same_point_m = 0.02f;
const float min_cos = std::cos(glm::radians(30.0f));

using Point = std::array<long, 3>;  // in steps of same_point_m

Point place_of(glm::vec3 at) {
  return {std::lround(at.x / same_point_m), std::lround(at.y / same_point_m),
          std::lround(at.z / same_point_m)};
}

/// Number of the highest corner.
std::size_t top_of(const ModelTriangle& triangle) {
  const auto highest = std::ranges::max_element(triangle.corners, {}, &glm::vec3::z);
  return std::size_t(highest - triangle.corners.begin());
}

}  // namespace

std::vector<std::optional<std::array<glm::vec3, 3>>> cone_normals(const std::vector<ModelTriangle>& roofs) {
  std::map<Point, std::vector<std::size_t>> around;
  for (std::size_t i = 0; i < roofs.size(); ++i)
    around[place_of(roofs[i].corners[top_of(roofs[i])])].push_back(i);
  std::vector<std::optional<std::array<glm::vec3, 3>>> normals(roofs.size());
  for (const auto& [top, sides] : around) {
    if (sides.size() < min_sides || sides.size() > max_sides) continue;
    std::map<Point, std::vector<std::size_t>> at_foot;  // the two sides that meet at an edge
    for (const std::size_t i : sides)
      for (const glm::vec3& corner : roofs[i].corners) at_foot[place_of(corner)].push_back(i);
    for (const std::size_t i : sides) {
      normals[i] = {roofs[i].normal, roofs[i].normal, roofs[i].normal};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::vector<std::size_t>& both = at_foot.at(place_of(roofs[i].corners[k]));
        if (k == top_of(roofs[i]) || both.size() != 2) continue;
        const glm::vec3 other = roofs[both[0] == i ? both[1] : both[0]].normal;
        if (glm::dot(roofs[i].normal, other) >= min_cos)
          (*normals[i])[k] = glm::normalize(roofs[i].normal + other);
      }
    }
  }
  return normals;
}

}  // namespace parvis::dressing
