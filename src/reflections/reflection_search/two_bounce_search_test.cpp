#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "base/random.h"
#include "base/test_directions.h"
#include "reflections/reflection_search/map_window.h"
#include "reflections/reflection_search/test_ellipsoid.h"

namespace parvis::reflection_search {
namespace {

#include "reflections/reflection_search/search_limits.glsl"

/// Two ellipsoids, the second moved: the shaders' own search.
struct Pair {
  std::array<Ellipsoid, 2> mirrors;
  glm::vec3 second_place;
  int mirror = 0;

#include "reflections/reflection_search/surface_point.glsl"
  // Each needs those before it: lines between them keep clang-format from sorting.
#include "reflections/reflection_search/reflection_point.glsl"
  //
#include "reflections/reflection_search/newton_search.glsl"
  //
#include "reflections/reflection_search/patch_search.glsl"
  //
#include "reflections/reflection_search/two_bounce_search.glsl"

  void turn_to(int to) { mirror = to; }
  glm::vec3 across(glm::vec3 point, int to) const {
    return to == 1 ? point - second_place : point + second_place;
  }
  SurfacePoint surface_at(glm::vec3 direction) const {
    const auto [position, normal] = mirrors[std::size_t(mirror)].surface(direction);
    return {position, normal, kind_surface};
  }
  SearchStart search_start(int i) {
    const bool is_first = i < search_start_count;  // those, and all further ones, are spread all around
    const int count = is_first ? search_start_count : all_start_count - search_start_count;
    const float turn = 2.4f * float(i), z = -1.0f + (2.0f * float((7 * i) % count) + 1.0f) / float(count);
    const TangentPlane plane = tangent_plane(
        surface_at({std::sqrt(1.0f - z * z) * std::cos(turn), std::sqrt(1.0f - z * z) * std::sin(turn), z}),
        vec3(0.0f));
    return {plane, surface_curvature(plane, vec3(0.0f), 1.0f)};
  }
  SearchStart further_start(int i) { return search_start(i); }
  static MapWindow map_window() { return all_directions; }
};

/// Where a ray hits an ellipsoid about the origin.
std::optional<glm::vec3> hit(const Ellipsoid& ellipsoid, glm::vec3 origin, glm::vec3 direction) {
  const glm::dvec3 o = glm::dvec3(origin) / glm::dvec3(ellipsoid.radii),
                   d = glm::dvec3(direction) / glm::dvec3(ellipsoid.radii);
  const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - 1.0, root = b * b - a * c;
  if (root <= 0.0) return {};
  const double path = (-b - std::sqrt(root)) / a;
  if (path <= 0.0) return {};
  return origin + float(path) * direction;
}

struct LightPath {
  glm::vec3 viewer, first, second, vertex;  ///< in the first mirror's frame
};

/// A light path over both mirrors, traced from its first point.
std::optional<LightPath> random_path(const Pair& pair, Random& random) {
  const auto [first, normal] = pair.mirrors[0].surface(random_direction(random));
  const glm::vec3 viewer = random.uniform(2.0f, 6.0f) * random_direction(random) * pair.mirrors[0].radii;
  const glm::vec3 in = glm::normalize(first - viewer);
  if (glm::dot(in, normal) > -0.15f) return {};  // not from behind, nor along it
  const glm::vec3 between = glm::reflect(in, normal);
  const auto second = hit(pair.mirrors[1], first - pair.second_place, between);
  if (!second) return {};
  const glm::vec3 normal_there = pair.mirrors[1].surface(*second).second;
  if (glm::dot(between, normal_there) > -0.15f) return {};
  const glm::vec3 out = glm::reflect(between, normal_there), at = *second + pair.second_place;
  return LightPath{viewer, first, at, at + random.uniform(0.3f, 4.0f) * out};
}

/// Fraction of paths that the search finds, each point within a thousandth of the mirrors' size.
double share_found(Pair pair) {
  Random random(3);
  int paths = 0, found = 0;
  while (paths < 500) {
    const std::optional<LightPath> path = random_path(pair, random);
    if (!path) continue;
    ++paths;
    const Pair::PatchKind whole{true, true};
    const Pair::TwoBounces at = pair.search_two_bounces(
        {path->viewer, pair.second_place, glm::vec3(0.0f)}, whole, -1,
        {glm::vec3(0.0f), path->vertex - pair.second_place, glm::vec3(0.0f)}, whole, -1);
    const float off = glm::distance(at.first.point.position, path->first) +
                      glm::distance(at.second.point.position + pair.second_place, path->second);
    found += at.first.point.angle < found_angle && at.second.point.angle < found_angle && off < 2e-3f;
  }
  return double(found) / paths;
}

TEST(TwoBounceSearch, FindsTheWayThatLightTakes) {
  EXPECT_GT(share_found({{}, {3.5f, 0.4f, 0.2f}}), 0.995);
  EXPECT_GT(share_found({{Ellipsoid{{1.0f, 0.6f, 0.8f}}, Ellipsoid{{0.5f, 0.9f, 0.7f}}}, {2.4f, 0.4f, 0.2f}}),
            0.98);
}

TEST(TwoBounceSearch, FindsItBetweenMirrorsThatNearlyTouch) {
  EXPECT_GT(share_found({{}, {2.1f, 0.0f, 0.0f}}), 0.9);
}

}  // namespace
}  // namespace parvis::reflection_search
