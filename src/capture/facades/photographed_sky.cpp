#include "capture/facades/photographed_sky.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/colour.h"
#include "base/parallel.h"
#include "capture/facades/surface_points.h"
#include "graphics/shading/sky.h"

namespace parvis::facades {
namespace {

constexpr int sky_width = 256, sky_height = 128;
constexpr float plaster_albedo = 0.45f;
constexpr float min_sky_scale = 0.5f, max_sky_scale = 8.0f;
constexpr float pi = 3.14159265f;

/// The triangles of the backdrop; an empty run without one.
TriangleRun backdrop_run(const PackedFacade& facade) {
  std::size_t first = facade.triangle_count(), last = 0;
  for (std::size_t t = 0; t < facade.triangle_count(); ++t)
    if (facade.surfaces[facade.surface_of_triangle[t]] == backdrop_name)
      first = std::min(first, t), last = t + 1;
  return {std::min(first, last), last};
}

/// Where a ray from `origin` intersects one of the triangles (Möller and Trumbore 1997).
std::optional<SurfacePoints::Point> seen_along(const PackedFacade& facade, const TriangleRun& run,
                                               glm::vec3 origin, glm::vec3 direction) {
  for (std::size_t t = run.first; t < run.second; ++t) {
    const glm::vec3* c = facade.corners.data() + 3 * t;
    const glm::vec3 u = c[1] - c[0], v = c[2] - c[0], p = glm::cross(direction, v), from = origin - c[0];
    const float determinant = glm::dot(u, p);
    if (determinant == 0.0f) continue;
    const glm::vec3 q = glm::cross(from, u);
    const glm::vec2 weights(glm::dot(from, p) / determinant, glm::dot(direction, q) / determinant);
    const float distance = glm::dot(v, q) / determinant;
    if (!(distance > 0.0f && weights.x >= 0.0f && weights.y >= 0.0f && weights.x + weights.y <= 1.0f))
      continue;
    return SurfacePoints::Point{t, weights, origin + distance * direction};
  }
  return std::nullopt;
}

glm::vec3 direction_of_pixel(int x, int y) {
  const float azimuth = 2.0f * pi * ((float(x) + 0.5f) / sky_width - 0.5f),
              polar = pi * (float(y) + 0.5f) / sky_height;
  return {std::sin(polar) * std::sin(azimuth), std::sin(polar) * std::cos(azimuth), std::cos(polar)};
}

/// The factor that makes the median wall reflect as much of the sky's light as plaster does.
float scale_of_sky(const ImageF& sky, std::span<const WallSample> walls) {
  shading::SkyLight light = shading::make_sky_light(sky, 1.0f, 0.0f);
  std::vector<float> factors;
  for (const WallSample& wall : walls) {
    const float irradiance = luminance(shading::sky_irradiance(light.irradiance_sh.data(), wall.normal));
    if (irradiance > 0.0f) factors.push_back(pi * luminance(wall.radiance) / (plaster_albedo * irradiance));
  }
  if (factors.empty()) return 1.0f;
  const auto middle = factors.begin() + std::ptrdiff_t(factors.size() / 2);
  std::ranges::nth_element(factors, middle);
  return std::clamp(*middle, min_sky_scale, max_sky_scale);
}

}  // namespace

ImageF photographed_sky(const PackedFacade& facade, const FacadeTexels& texels, glm::vec3 middle,
                        std::span<const WallSample> walls) {
  glm::dvec3 sum(0.0);
  for (const WallSample& wall : walls) sum += glm::dvec3(wall.radiance);
  const glm::vec3 below = walls.empty() ? glm::vec3(0.2f) : glm::vec3(sum / double(walls.size()));
  const TriangleRun run = backdrop_run(facade);
  ImageF sky(sky_width, sky_height, 3);
  parallel_for(std::size_t(sky_height), [&](std::size_t y) {
    FacadeLookup lookup(facade, &texels);
    for (int x = 0; x < sky_width; ++x) {
      const glm::vec3 direction = direction_of_pixel(x, int(y));
      const std::optional<SurfacePoints::Point> point =
          direction.z > 0.0f ? seen_along(facade, run, middle, direction) : std::nullopt;
      const glm::vec3 above(luminance(below) * 2.0f);  // an even sky over walls of plaster
      const glm::vec3 radiance = direction.z <= 0.0f ? below
                                 : point ? recorded_radiance(lookup, *point, middle).value_or(above)
                                         : above;
      for (int c = 0; c < 3; ++c) sky.at(x, int(y))[c] = radiance[c];
    }
  });
  const float scale = scale_of_sky(sky, walls);
  for (float& value : sky.pixels) value *= scale;
  return sky;
}

}  // namespace parvis::facades
