#include "capture/facades/surface_points.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "graphics/shading/recorded_light.h"

namespace parvis::facades {

std::vector<TriangleRun> runs_of_surfaces(const PackedFacade& facade) {
  std::vector<TriangleRun> runs;
  for (std::size_t first = 0, last = 0; first < facade.triangle_count(); first = last) {
    while (last < facade.triangle_count() &&
           facade.surface_of_triangle[last] == facade.surface_of_triangle[first])
      ++last;
    if (facade.surfaces[facade.surface_of_triangle[first]] != backdrop_name) runs.emplace_back(first, last);
  }
  return runs;
}

glm::vec3 middle_of_photographs(const PackedFacade& facade) {
  glm::dvec3 middle(0.0);
  for (const PackedPhoto& photo : facade.photos) middle += photo.view.centre;
  if (!facade.photos.empty()) middle /= double(facade.photos.size());
  return glm::vec3(middle);
}

SurfacePoints::SurfacePoints(const PackedFacade& facade, const TriangleRun& run)
    : facade_(facade), first_(run.first) {
  for (std::size_t t = run.first; t < run.second; ++t) {
    const glm::vec3* c = facade.corners.data() + 3 * t;
    area_.push_back((area_.empty() ? 0.0 : area_.back()) +
                    double(glm::length(glm::cross(c[1] - c[0], c[2] - c[0]))));
  }
}

SurfacePoints::Point SurfacePoints::next() {
  const double at = double(random_.uniform()) * area_.back();
  const auto found = std::ranges::lower_bound(area_, at);
  const std::size_t triangle = first_ + std::size_t(found - area_.begin());
  const float across = std::sqrt(random_.uniform()), along = random_.uniform();
  const glm::vec2 weights(across * (1.0f - along), across * along);
  const glm::vec3* c = facade_.corners.data() + 3 * triangle;
  return {triangle, weights, c[0] + weights.x * (c[1] - c[0]) + weights.y * (c[2] - c[0])};
}

std::optional<glm::vec3> recorded_radiance(FacadeLookup& lookup, const SurfacePoints::Point& point,
                                           glm::vec3 eye) {
  const glm::vec3 away = eye - point.position;
  const float distance_m = std::max(glm::length(away), 1e-6f);
  const glm::vec4 colour = lookup.colour(std::uint32_t(point.triangle), point.position, away / distance_m,
                                         1e-3f * distance_m, point.barycentric);
  if (colour.w < 0.5f) return std::nullopt;
  return shading::tone_unmapped(
      linear_from_srgb(glm::clamp(glm::vec3(colour), glm::vec3(0.0f), glm::vec3(1.0f))));
}

}  // namespace parvis::facades
