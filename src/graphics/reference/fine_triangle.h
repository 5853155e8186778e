// Rays against triangles in double precision, and triangles grown so that single precision misses none that
// double precision hits.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

namespace parvis::reference {

/// A ray in double precision: a hit counts between `min_m` and `max_m` along it.
struct FineRay {
  glm::dvec3 origin, direction;  ///< unit direction
  double min_m = 1e-4, max_m = 1e30;
};

/// Where a ray crosses a triangle: barycentric weights of the second and third corner.
struct Crossing {
  double distance_m, u, v;
  bool is_back;  ///< the corners go clockwise as the ray sees them
};

/// The crossing by the signed volumes of the ray with each edge; edges belong to the triangle. None for a
/// triangle without area.
inline std::optional<Crossing> crossing(const FineRay& ray, const std::array<glm::dvec3, 3>& corners) {
  const glm::dvec3 a = corners[0] - ray.origin, b = corners[1] - ray.origin, c = corners[2] - ray.origin;
  const double of_a = glm::dot(ray.direction, glm::cross(c, b)),
               of_b = glm::dot(ray.direction, glm::cross(a, c)),
               of_c = glm::dot(ray.direction, glm::cross(b, a));
  if ((of_a < 0.0 || of_b < 0.0 || of_c < 0.0) && (of_a > 0.0 || of_b > 0.0 || of_c > 0.0))
    return std::nullopt;
  const double sum = of_a + of_b + of_c;
  if (sum == 0.0) return std::nullopt;
  const double u = of_b / sum, v = of_c / sum;
  return Crossing{glm::dot(ray.direction, (1.0 - u - v) * a + u * b + v * c), u, v, sum < 0.0};
}

/// The triangle with each edge moved outward by `margin`: scaled about the centre of its inscribed circle. At
/// most nine times as large, and unchanged without area.
inline std::array<glm::vec3, 3> grown(const std::array<glm::vec3, 3>& corners, float margin) {
  constexpr float max_scale = 9.0f;
  const float a = glm::distance(corners[1], corners[2]), b = glm::distance(corners[2], corners[0]),
              c = glm::distance(corners[0], corners[1]), around = a + b + c;
  const float area = glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  if (!(area > 0.0f)) return corners;
  const glm::vec3 centre = (a * corners[0] + b * corners[1] + c * corners[2]) / around;
  const float scale =
      std::min(1.0f + margin * around / area, max_scale);  // the circle's radius: area / around
  return {centre + scale * (corners[0] - centre), centre + scale * (corners[1] - centre),
          centre + scale * (corners[2] - centre)};
}

}  // namespace parvis::reference
