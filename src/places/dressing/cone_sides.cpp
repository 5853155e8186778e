#include "places/dressing/cone_sides.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace parvis::dressing {
namespace {

constexpr std::size_t min_sides = 12, max_sides = 500;  // of more sides, none is seen
const float min_side_cos = std::cos(glm::radians(30.0f));

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

std::vector<std::optional<ConeSide>> cone_sides(const std::vector<ModelTriangle>& roofs) {
  std::map<Point, std::vector<std::size_t>> around;
  for (std::size_t i = 0; i < roofs.size(); ++i)
    around[place_of(roofs[i].corners[top_of(roofs[i])])].push_back(i);
  std::vector<std::optional<ConeSide>> found(roofs.size());
  for (const auto& [top, sides] : around) {
    if (sides.size() < min_sides || sides.size() > max_sides) continue;
    std::map<Point, std::vector<std::size_t>> at_foot;  // the two sides that meet at an edge
    for (const std::size_t i : sides)
      for (const glm::vec3& corner : roofs[i].corners) at_foot[place_of(corner)].push_back(i);
    ConeSide cone;
    for (const std::size_t i : sides)
      for (const glm::vec3& corner : roofs[i].corners) {
        const glm::vec3 down = corner - roofs[i].corners[top_of(roofs[i])];
        const float weight = 0.5f / float(sides.size());  // two corners of a side lie at the foot
        cone.radius_m += weight * glm::length(glm::vec2(down)), cone.slope_m += weight * glm::length(down);
      }
    for (const std::size_t i : sides) {
      cone.top = top_of(roofs[i]);
      cone.normals = {roofs[i].normal, roofs[i].normal, roofs[i].normal};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::vector<std::size_t>& both = at_foot.at(place_of(roofs[i].corners[k]));
        if (k == cone.top || both.size() != 2) continue;
        const glm::vec3 other = roofs[both[0] == i ? both[1] : both[0]].normal;
        if (glm::dot(roofs[i].normal, other) >= min_side_cos)
          cone.normals[k] = glm::normalize(roofs[i].normal + other);
      }
      found[i] = cone;
    }
  }
  return found;
}

}  // namespace parvis::dressing
