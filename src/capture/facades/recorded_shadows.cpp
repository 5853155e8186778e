#include "capture/facades/recorded_shadows.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/colour.h"
#include "base/parallel.h"
#include "base/random.h"
#include "capture/facades/facade_lookup.h"
#include "capture/photographs/shadow_strength.h"
#include "graphics/shading/recorded_light.h"

namespace parvis::facades {
namespace {

constexpr std::size_t points_per_surface = 1500;
constexpr std::size_t max_decoded_bytes = std::size_t(1) << 30;  // of texels, while a scene is read

/// Points of a run of triangles, evenly over their area.
class SurfacePoints {
 public:
  struct Point {
    std::size_t triangle;
    glm::vec2 barycentric;
    glm::vec3 position;
  };

  SurfacePoints(const PackedFacade& facade, std::size_t first, std::size_t last)
      : facade_(facade), first_(first) {
    for (std::size_t t = first; t < last; ++t) {
      const glm::vec3* c = facade.corners.data() + 3 * t;
      area_.push_back((area_.empty() ? 0.0 : area_.back()) +
                      double(glm::length(glm::cross(c[1] - c[0], c[2] - c[0]))));
    }
  }

  Point next() {
    const double at = double(random_.uniform()) * area_.back();
    const auto found = std::ranges::lower_bound(area_, at);
    const std::size_t triangle = first_ + std::size_t(found - area_.begin());
    const float across = std::sqrt(random_.uniform()), along = random_.uniform();
    const glm::vec2 weights(across * (1.0f - along), across * along);
    const glm::vec3* c = facade_.corners.data() + 3 * triangle;
    return {triangle, weights, c[0] + weights.x * (c[1] - c[0]) + weights.y * (c[2] - c[0])};
  }

 private:
  const PackedFacade& facade_;
  std::size_t first_;
  std::vector<double> area_;  ///< summed
  Random random_{7};
};

std::optional<photographs::LitAndShaded> shadows_of(const PackedFacade& facade, FacadeLookup& lookup,
                                                    std::size_t first, std::size_t last, glm::vec3 eye) {
  SurfacePoints points(facade, first, last);
  std::vector<glm::vec3> radiances;
  for (std::size_t i = 0; i < points_per_surface; ++i) {
    const SurfacePoints::Point point = points.next();
    const glm::vec3 away = eye - point.position;
    const float distance_m = std::max(glm::length(away), 1e-6f);
    const glm::vec4 colour = lookup.colour(std::uint32_t(point.triangle), point.position, away / distance_m,
                                           1e-3f * distance_m, point.barycentric);
    if (colour.w < 0.5f) continue;
    radiances.push_back(shading::tone_unmapped(
        linear_from_srgb(glm::clamp(glm::vec3(colour), glm::vec3(0.0f), glm::vec3(1.0f)))));
  }
  return photographs::lit_and_shaded(radiances);
}

}  // namespace

void find_shadows(PackedFacade& facade) {
  facade.lit_of_surface.clear();
  facade.kept_in_shadows = photographs::kept_in_usual_shadow;
  if (facade.blocks.size() * 16 * 4 > max_decoded_bytes) return;  // 16 texels of 4 bytes per block
  glm::dvec3 middle(0.0);
  for (const PackedPhoto& photo : facade.photos) middle += photo.view.centre;
  if (!facade.photos.empty()) middle /= double(facade.photos.size());
  std::vector<std::pair<std::size_t, std::size_t>> runs;  // of triangles, by surface
  for (std::size_t first = 0, last = 0; first < facade.triangle_count(); first = last) {
    while (last < facade.triangle_count() &&
           facade.surface_of_triangle[last] == facade.surface_of_triangle[first])
      ++last;
    if (facade.surfaces[facade.surface_of_triangle[first]] != backdrop_name) runs.emplace_back(first, last);
  }
  const FacadeTexels texels(facade);
  std::vector<std::optional<photographs::LitAndShaded>> found(runs.size());
  parallel_for(runs.size(), [&](std::size_t i) {
    FacadeLookup lookup(facade, &texels);
    found[i] = shadows_of(facade, lookup, runs[i].first, runs[i].second, glm::vec3(middle));
  });
  facade.kept_in_shadows = photographs::kept_in_shadows(found);
  facade.lit_of_surface.assign(facade.surfaces.size(), 0);
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (found[i])
      facade.lit_of_surface[facade.surface_of_triangle[runs[i].first]] =
          photographs::encoded_luminance(found[i]->lit);
}

}  // namespace parvis::facades
