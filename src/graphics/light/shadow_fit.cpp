#include "graphics/light/shadow_fit.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <span>

namespace parvis::light {
namespace {

constexpr int cascade_count = 4;
constexpr double border = 1.02;          // maps are a little larger than what they are fitted to
constexpr double max_half_angle = 1.25;  // radians, of a perspective map seen from its light
constexpr int max_retreats = 24;

struct Box {
  glm::dvec3 low{1e300}, high{-1e300};
  void add(glm::dvec3 p) { low = glm::min(low, p), high = glm::max(high, p); }
};

/// Rows: right, up, toward the sun. `along` is the direction that becomes up, as far as it can.
glm::dmat4 sun_from_world(glm::dvec3 to_sun, glm::dvec3 along) {
  glm::dvec3 right = glm::cross(along, to_sun);
  if (glm::length(right) < 1e-3)
    right = glm::cross(std::abs(to_sun.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0), to_sun);
  right = glm::normalize(right);
  const glm::dvec3 up = glm::cross(to_sun, right);
  return glm::transpose(
      glm::dmat4(glm::dvec4(right, 0), glm::dvec4(up, 0), glm::dvec4(to_sun, 0), glm::dvec4(0, 0, 0, 1)));
}

glm::dvec3 project(const glm::dmat4& m, glm::dvec3 p) {
  const glm::dvec4 h = m * glm::dvec4(p, 1.0);
  return glm::dvec3(h) / h.w;
}

/// Scales x and y of a transform so that `points` fill the square; depth stays.
glm::dmat4 filling_the_square(const glm::dmat4& m, const std::vector<glm::dvec3>& points) {
  Box box;
  for (const glm::dvec3& point : points) box.add(project(m, point));
  const glm::dvec3 centre = 0.5 * (box.low + box.high),
                   half = glm::max(0.5 * border * (box.high - box.low), glm::dvec3(1e-9));
  return glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 / half.x, 1.0 / half.y, 1.0)) *
         glm::translate(glm::dmat4(1.0), glm::dvec3(-centre.x, -centre.y, 0.0)) * m;
}

std::vector<glm::dvec3> corners_of(const Bounds& bounds) {
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y,
                         i & 4 ? bounds.max.z : bounds.min.z);
  return corners;
}

std::vector<ShadowMap> cascades(const glm::dmat4& sun, const std::vector<glm::dvec3>& points,
                                const std::vector<float>& depths) {
  const auto [nearest, farthest] = std::minmax_element(depths.begin(), depths.end());
  const double low = std::max(double(*nearest), 1e-2), ratio = std::max(double(*farthest) / low, 1.0 + 1e-9);
  std::vector<ShadowMap> maps;
  for (int i = 0; i < cascade_count; ++i) {
    const double from = i == 0 ? 0.0 : low * std::pow(ratio, double(i) / cascade_count);
    const double to = i + 1 == cascade_count ? 1e30 : low * std::pow(ratio, double(i + 1) / cascade_count);
    std::vector<glm::dvec3> inside;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (double(depths[k]) >= from && double(depths[k]) <= to) inside.push_back(points[k]);
    if (inside.empty()) inside = points;
    maps.push_back({filling_the_square(sun, inside), to, 0.5});
  }
  return maps;
}

/// How far the viewpoint moves back so that all that can shade the points stands in front of it.
double retreat_for_casters(const glm::dmat4& camera_from_world, glm::dvec3 to_sun,
                           const std::vector<glm::dvec3>& points, double top, double near_m) {
  double minimum = near_m;
  for (const glm::dvec3& point : points) {
    const double reach = std::max(0.0, top - point.z) / std::max(to_sun.z, 0.05);
    for (const glm::dvec3& end : {point, point + reach * to_sun})
      minimum = std::min(minimum, -(camera_from_world * glm::dvec4(end, 1.0)).z);
  }
  return near_m - minimum;
}

/// The map of the space after a projection whose viewpoint has moved back; nothing where its light sees the
/// points under too wide an angle.
bool perspective_map(const Camera& camera, glm::dvec3 to_sun, const std::vector<glm::dvec3>& points,
                     double near_m, double far_m, double retreat_m, glm::dmat4& result) {
  const glm::dmat4 camera_from_world = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -retreat_m)) *
                                       glm::inverse(glm::dmat4(camera.world_from_camera));
  const double tangent = 0.5 * double(camera.height_at_1m()), n = near_m + retreat_m * 0.999,
               f = far_m + retreat_m;
  const glm::dmat4 view = glm::perspective(2.0 * std::atan(tangent), 1.0, n, f) * camera_from_world;
  std::vector<glm::dvec3> seen;
  Box box;
  for (const glm::dvec3& point : points) seen.push_back(project(view, point)), box.add(seen.back());
  const glm::dvec4 light = view * glm::dvec4(to_sun, 0.0);
  const glm::dvec3 centre = 0.5 * (box.low + box.high);
  if (std::abs(light.w) < 1e-4) {  // the sun stands across: its rays stay parallel
    result = filling_the_square(sun_from_world(glm::normalize(glm::dvec3(light)), {0, 0, 1}) * view, points);
    return true;
  }
  const glm::dvec3 position = glm::dvec3(light) / light.w, axis = glm::normalize(centre - position);
  double widest = 0.0;
  for (const glm::dvec3& p : seen)
    widest = std::max(widest, std::acos(std::clamp(glm::dot(glm::normalize(p - position), axis), -1.0, 1.0)));
  if (widest > max_half_angle) return false;
  const glm::dvec3 up = std::abs(axis.z) < 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dmat4 from_light =
      glm::perspective(2.0 * widest + 1e-6, 1.0, 1e-3, 1e3) * glm::lookAt(position, centre, up);
  result = filling_the_square(from_light * view, points);
  return true;
}

glm::dmat4 perspective(const Camera& camera, glm::dvec3 to_sun, const SeenSurfaces& seen,
                       const std::vector<glm::dvec3>& points, const Bounds& casters, const glm::dmat4& sun) {
  const auto [nearest, farthest] = std::minmax_element(seen.depths_m.begin(), seen.depths_m.end());
  const double near_m = std::max(double(*nearest) * 0.98, 1e-2), far_m = double(*farthest) * 1.02;
  const glm::dmat4 camera_from_world = glm::inverse(glm::dmat4(camera.world_from_camera));
  double retreat_m = retreat_for_casters(camera_from_world, to_sun, points, double(casters.max.z), near_m);
  glm::dmat4 result(1.0);
  for (int i = 0; i < max_retreats; ++i, retreat_m = std::max(2.0 * retreat_m, 0.25 * near_m))
    if (perspective_map(camera, to_sun, points, near_m, far_m, retreat_m, result)) return result;
  return filling_the_square(sun, points);  // from so far away that nothing is left of the perspective
}

glm::dmat4 light_space_perspective(const Camera& camera, glm::dvec3 to_sun, const SeenSurfaces& seen,
                                   const std::vector<glm::dvec3>& points) {
  const glm::dvec3 forward(camera.forward_in_world());
  const glm::dmat4 sun = sun_from_world(to_sun, forward);
  Box box;
  for (const glm::dvec3& point : points) box.add(project(sun, point));
  const auto [nearest, farthest] = std::minmax_element(seen.depths_m.begin(), seen.depths_m.end());
  const double sine = std::sqrt(std::max(0.0, 1.0 - std::pow(glm::dot(forward, to_sun), 2.0)));
  const double zn = double(*nearest), zf = double(*farthest);
  // Wimmer's choice of the distance of the projection's centre; towards infinity when one looks into the
  // light
  const double n = (zn + std::sqrt(zn * zf)) / std::max(sine, 1e-3);
  const double y0 = box.low.y - n, d = std::max(box.high.y - box.low.y, 1e-6),
               x0 = 0.5 * (box.low.x + box.high.x);
  // x/w, z/w, and y so that it grows: w is the distance from the centre along y
  glm::dmat4 warp(0.0);
  warp[0][0] = 1.0, warp[3][0] = -x0;
  warp[1][1] = (n + d) / d, warp[3][1] = -(n + d) / d * y0 - n * (n + d) / d;
  warp[2][2] = 1.0;
  warp[1][3] = 1.0, warp[3][3] = -y0;
  return filling_the_square(warp * sun, points);
}

}  // namespace

std::vector<ShadowMap> fit_shadow_maps(ShadowMethod method, const Camera& camera, glm::vec3 sun_direction,
                                       const SeenSurfaces& seen, const Bounds& casters) {
  const glm::dvec3 to_sun(sun_direction);
  const glm::dmat4 sun = sun_from_world(to_sun, glm::dvec3(camera.forward_in_world()));
  const std::vector<glm::dvec3> points(seen.positions.begin(), seen.positions.end());
  if (points.empty()) return {{filling_the_square(sun, corners_of(casters))}};
  switch (method) {
    case ShadowMethod::cascades:
      return cascades(sun, points, seen.depths_m);
    case ShadowMethod::perspective:
      return {{perspective(camera, to_sun, seen, points, casters, sun)}};
    case ShadowMethod::light_space_perspective:
      return {{light_space_perspective(camera, to_sun, seen, points)}};
    case ShadowMethod::uniform:
      break;
  }
  return {{filling_the_square(sun, points)}};
}

TexelPoint texel_point(const ShadowMap& map, int resolution, glm::dvec3 point) {
  const glm::dmat4 world_from_map = glm::inverse(map.map_from_world);
  const glm::dvec3 at = project(map.map_from_world, point);
  const double texels = map.share * resolution;
  const auto middle = [&](double x) {
    return (std::floor((0.5 * x + 0.5) * texels) + 0.5) / texels * 2.0 - 1.0;
  };
  const glm::dvec3 centre = project(world_from_map, {middle(at.x), middle(at.y), at.z});
  const double step = 2.0 / texels;
  const double size = std::max(glm::distance(project(world_from_map, {at.x + step, at.y, at.z}), point),
                               glm::distance(project(world_from_map, {at.x, at.y + step, at.z}), point));
  return {centre, size};
}

const ShadowMap& map_for_depth(std::span<const ShadowMap> maps, double depth_m) {
  for (const ShadowMap& map : maps)
    if (depth_m <= map.max_depth_m) return map;
  return maps.back();
}

}  // namespace parvis::light
