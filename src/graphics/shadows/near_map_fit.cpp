// Depth of a projective map. Its rows X, Y and W come from the method: x = X/W and y = Y/W are the same all
// along a line toward the sun s. Depth is (B - s.p) / W, scaled: along a line p + t s, with k = W(s) and
// c = B - s.p, its derivative is -(W + k c) / W^2, and W + k c is the same all along. Where that is positive,
// what is nearer to the sun has the smaller depth, whether the sun is a source or a sink of the projected
// space (Stamminger and Drettakis 2002, section 3). B lies among the receivers, as far as that allows: from
// texel to texel W changes, and with it the depth by c / W^2, which would shade surfaces by themselves.
#include "graphics/shadows/near_map_fit.h"

#include <algorithm>
#include <cmath>

#include "graphics/reference/camera_ray.h"

namespace parvis::shadows {
namespace {

constexpr int samples_across = 72, samples_up = 48;
constexpr float sampled_aspect = 1.8f;
constexpr double moving_height_m = 30.0;  // dynamic objects stand no higher above static ones
constexpr int resolution = light::SunShadowMaps::map_size;

using light::ShadowMap;

/// Steps of an eighth of an octave, so that maps keep their scale while the view changes a little.
glm::dvec2 stepped(glm::dvec2 half) {
  return glm::exp2(glm::ceil(8.0 * glm::log2(glm::max(half, glm::dvec2(1e-3)))) / 8.0);
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The range from the top of the casters to the lowest of them, along the sun.
glm::dvec2 depth_range(const Bounds& casters, glm::dvec3 to_sun) {
  glm::dvec2 range(1e300, -1e300);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p(corner & 1 ? casters.max.x : casters.min.x, corner & 2 ? casters.max.y : casters.min.y,
                       corner & 4 ? casters.max.z : casters.min.z);
    range = {std::min(range.x, glm::dot(p, to_sun)), std::max(range.y, glm::dot(p, to_sun))};
  }
  return {range.x - 1.0, range.y + moving_height_m};
}

/// Axes of a map across the sun: `forward` goes up in it, in steps of a 128th of a turn, so that maps keep
/// their texels while the view turns a little. What a view shows is long in that direction.
std::array<glm::dvec3, 2> map_axes(glm::dvec3 to_sun, glm::dvec3 forward) {
  constexpr double steps = 128.0 / 6.283185307179586;
  const glm::dvec3 aside = std::abs(to_sun.z) < 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(aside, to_sun)), up = glm::cross(to_sun, right);
  const double turn = std::round(steps * std::atan2(glm::dot(forward, right), glm::dot(forward, up))) / steps;
  return {std::cos(turn) * right - std::sin(turn) * up, std::sin(turn) * right + std::cos(turn) * up};
}

/// Orthographic maps as quarters of one, the coarsest first. Rectangles of stepped size stand on whole texels
/// of theirs: edges do not crawl when the viewer moves.
light::NearMap tiled_map(const std::vector<ShadowMap>& maps, glm::dvec3 to_sun, glm::dvec3 forward,
                         const Bounds& casters) {
  struct Rectangle {
    glm::dvec2 centre, half;
  };
  const auto [right, up] = map_axes(to_sun, forward);
  std::vector<Rectangle> rectangles;
  for (auto map = maps.rbegin(); map != maps.rend(); ++map) {
    const glm::dmat4 world_from_map = glm::inverse(map->map_from_world);
    glm::dvec2 low(1e300), high(-1e300);
    for (int corner = 0; corner < 4; ++corner) {
      const glm::dvec3 p(world_from_map * glm::dvec4(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, 0, 1));
      const glm::dvec2 at(glm::dot(p, right), glm::dot(p, up));
      low = glm::min(low, at), high = glm::max(high, at);
    }
    // no thinner than an eighth of its length: texels stay compact
    const glm::dvec2 longest(std::max(high.x - low.x, high.y - low.y));
    const glm::dvec2 half = stepped(0.5 * glm::max(high - low, longest / 8.0));
    const glm::dvec2 texel = 4.0 * half / double(resolution);
    rectangles.push_back({glm::round(0.5 * (low + high) / texel) * texel, half});
  }
  glm::dvec2 low(1e300), high(-1e300);
  for (const Rectangle& each : rectangles)
    low = glm::min(low, each.centre - each.half), high = glm::max(high, each.centre + each.half);
  const glm::dvec2 centre = 0.5 * (low + high);
  const double half = 0.5 * std::max(high.x - low.x, high.y - low.y);

  const glm::dvec2 range = depth_range(casters, to_sun);
  const glm::dmat4 rows(glm::dvec4(right, -centre.x) / half, glm::dvec4(up, -centre.y) / half,
                        glm::dvec4(-2.0 * to_sun, range.x + range.y) / (range.y - range.x),
                        glm::dvec4(0, 0, 0, 1));
  light::NearMap near;
  near.clip_from_world = glm::mat4(glm::transpose(rows));
  near.texel_m = float(2.0 * half / resolution);
  near.tile_count = int(rectangles.size());
  for (std::size_t i = 0; i < rectangles.size(); ++i) {
    const glm::dvec2 scale = 0.5 * half / rectangles[i].half;
    const glm::dvec2 corner(0.5 * double(i % 2), 0.5 * double(i / 2));
    // the rectangle's low corner in uv of the whole comes to the quarter's
    const glm::dvec2 low_uv = 0.5 + 0.5 * (rectangles[i].centre - rectangles[i].half - centre) / half;
    near.tiles[i] = glm::vec4(glm::dvec4(scale, corner - scale * low_uv));
  }
  return near;
}

/// The diagonal of a texel about a point, in metres on a plane that faces the sun: by how that plane changes
/// over the map.
double texel_size(const glm::dmat4& map_from_world, glm::dvec3 to_sun, glm::dvec3 p) {
  constexpr double step_m = 1e-3;
  const glm::dvec3 u = glm::normalize(
      glm::cross(std::abs(to_sun.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0), to_sun));
  const auto at = [&](glm::dvec3 q) {
    const glm::dvec4 h = map_from_world * glm::dvec4(q, 1.0);
    return glm::dvec2(h) / h.w;
  };
  const glm::dmat2 map_from_plane((at(p + step_m * u) - at(p)) / step_m,
                                  (at(p + step_m * glm::cross(to_sun, u)) - at(p)) / step_m);
  const glm::dmat2 plane_from_map = glm::inverse(map_from_plane);
  return 2.0 / resolution * (glm::length(plane_from_map[0]) + glm::length(plane_from_map[1]));
}

/// How large texels are about the points: t w max(1, g w).
void measure_texels(const ShadowMap& map, const glm::dvec4& w_row, glm::dvec3 to_sun,
                    const light::SeenSurfaces& seen, light::NearMap& near) {
  std::vector<std::pair<double, double>> sizes;  // w, and the size over w
  const std::size_t step = std::max<std::size_t>(1, seen.positions.size() / 200);
  for (std::size_t i = 0; i < seen.positions.size(); i += step) {
    const glm::dvec3 p(seen.positions[i]);
    const double w = glm::dot(w_row, glm::dvec4(p, 1.0));
    if (w > 1e-6) sizes.emplace_back(w, texel_size(map.map_from_world, to_sun, p) / w);
  }
  std::ranges::sort(sizes);
  std::vector<double> of_near, of_far;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (2 * i < sizes.size())
      of_near.push_back(sizes[i].second);
    else
      of_far.push_back(sizes[i].second / sizes[i].first);
  near.texel_m = float(std::max(quantile(of_near, 0.9), 1e-6));
  near.growth = float(std::max(quantile(of_far, 0.9) / double(near.texel_m), 1e-9));
}

light::NearMap projective_map(const ShadowMap& map, glm::dvec3 to_sun, const light::SeenSurfaces& seen,
                              const Bounds& casters) {
  glm::dmat4 rows = glm::transpose(map.map_from_world);
  std::vector<double> w;
  w.reserve(seen.positions.size());
  for (const glm::vec3& p : seen.positions) w.push_back(glm::dot(rows[3], glm::dvec4(p, 1.0)));
  const double middle = quantile(w, 0.5);
  for (int row : {0, 1, 3}) rows[row] /= middle == 0.0 ? 1.0 : middle;  // positive, and about 1

  const double k = glm::dot(glm::dvec3(rows[3]), to_sun);
  const glm::dvec2 range = depth_range(casters, to_sun);
  double b = 0.0;
  for (const glm::vec3& p : seen.positions)
    b += glm::dot(glm::dvec3(p), to_sun) / double(seen.positions.size());
  for (std::size_t i = 0; i < w.size() && std::abs(k) > 1e-9; ++i) {
    const double height = glm::dot(glm::dvec3(seen.positions[i]), to_sun);
    const double reach = 0.9 * (w[i] / middle) / k;  // of W + k c > 0, with a tenth to spare
    b = k > 0.0 ? std::max(b, height - reach) : std::min(b, height - reach);
  }
  const auto depth = [&](glm::dvec3 p) {
    return (b - glm::dot(p, to_sun)) / std::max(glm::dot(rows[3], glm::dvec4(p, 1.0)), 1e-4);
  };
  double low = 1e300, high = -1e300;
  for (const glm::vec3& position : seen.positions) {
    const glm::dvec3 p(position);
    const double to_top = range.y - glm::dot(p, to_sun);
    low = std::min(low, depth(p + to_top * to_sun)), high = std::max(high, depth(p - 0.5 * to_sun));
  }
  const double alpha = 2.0 / std::max(high - low, 1e-9), gamma = -1.0 - alpha * low;
  rows[2] = gamma * rows[3] + alpha * glm::dvec4(-to_sun, b);

  light::NearMap near;
  near.clip_from_world = glm::mat4(glm::transpose(rows));
  measure_texels(map, rows[3], to_sun, seen, near);
  return near;
}

}  // namespace

light::SeenSurfaces seen_surfaces(const reference::RayScene& rays, const Camera& camera, bool updates_near) {
  light::SeenSurfaces seen;
  const glm::vec3 eye = camera.position_in_world(), forward = camera.forward_in_world();
  constexpr int height = 1000, width = int(sampled_aspect * height);
  for (int y = 0; y < samples_up; ++y)
    for (int x = 0; x < samples_across; ++x) {  // to the very edges of the picture
      const glm::vec2 at(float(width) * float(x) / float(samples_across - 1),
                         float(height) * float(y) / float(samples_up - 1));
      const reference::Ray ray = reference::camera_ray(camera, width, height, at);
      const auto hit = rays.nearest_hit(ray);
      if (!hit) continue;
      seen.positions.push_back(eye + hit->distance_m * ray.direction);
      seen.depths_m.push_back(glm::dot(seen.positions.back() - eye, forward));
    }
  if (!updates_near && !seen.positions.empty()) {
    seen.positions.push_back(eye + camera.near_m * forward);
    seen.depths_m.push_back(camera.near_m);
  }
  return seen;
}

light::NearMap fit_near_map(light::ShadowMethod method, const Camera& camera, glm::vec3 to_sun,
                            const light::SeenSurfaces& seen, const Bounds& casters) {
  const std::vector<ShadowMap> maps = light::fit_shadow_maps(method, camera, to_sun, seen, casters);
  if (maps.size() == 1 && !seen.positions.empty())
    return projective_map(maps.front(), glm::dvec3(to_sun), seen, casters);
  light::NearMap near = tiled_map(maps, glm::dvec3(to_sun), glm::dvec3(camera.forward_in_world()), casters);
  if (maps.size() == 1) near.tile_count = 0, near.tiles = {};  // nothing is seen
  return near;
}

}  // namespace parvis::shadows
