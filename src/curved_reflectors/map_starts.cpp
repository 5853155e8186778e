#include "curved_reflectors/map_starts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "curved_reflectors/reflection_search.h"
#include "curved_reflectors/reflector_map.h"

namespace parvis::curved_reflectors {
namespace {

using Search = ReflectionSearch<ReflectorMap>;

constexpr float pi = 3.14159265f;
constexpr float middle_share = 0.3f;               // of a band's breadth, in which searches begin
constexpr int bend_probes = 16, least_probes = 4;  // about a start
constexpr float bend_reach = 0.6f;                 // of the way to the next start

/// Directions to the triangles of a patch; of a rim, to those along its middle: beside its edges normals
/// point away from most that it shows.
std::vector<glm::vec3> start_directions(const ReflectorMesh& mesh, const ReflectorPatch& patch,
                                        const MapWindow& window) {
  std::vector<glm::vec3> all, in_middle;
  for (const std::uint32_t t : patch.triangles) {
    const auto [a, b, c] = mesh.corners(t);
    all.push_back(glm::normalize(a + b + c - 3.0f * patch.centre));
    const float off_axis = std::acos(glm::clamp(glm::dot(all.back(), window.axes[2]), -1.0f, 1.0f));
    const float off_middle = off_axis - window.band.y - 0.5f * window.band.z;
    if (std::abs(off_middle) < 0.5f * middle_share * window.band.z) in_middle.push_back(all.back());
  }
  return in_middle.empty() ? all : in_middle;
}

/// Directions to triangles of the patch, the first near its middle, each of the others as far as can be from
/// those before.
std::array<glm::vec3, start_count> spread_directions(const ReflectorMesh& mesh, const ReflectorPatch& patch,
                                                     const MapWindow& window) {
  const glm::vec3 middle = window.axes[2];
  const std::vector<glm::vec3> directions = start_directions(mesh, patch, window);
  std::array<glm::vec3, start_count> starts;
  starts[0] = *std::max_element(directions.begin(), directions.end(), [&](glm::vec3 a, glm::vec3 b) {
    return glm::dot(a, middle) < glm::dot(b, middle);
  });
  std::vector<float> nearest(directions.size(), -2.0f);  // cosine to the nearest start
  for (std::size_t i = 1; i < starts.size(); ++i) {
    for (std::size_t k = 0; k < directions.size(); ++k)
      nearest[k] = std::max(nearest[k], glm::dot(directions[k], starts[i - 1]));
    starts[i] = directions[std::size_t(std::min_element(nearest.begin(), nearest.end()) - nearest.begin())];
  }
  return starts;
}

/// How a surface bends about a start, as far as `reach`: the symmetric matrix (uu, uv, vv) by which, over
/// rings of probes, the normal's turn is best told from the way (least squares).
glm::vec3 bend_about(const ReflectorMap& map, const Search::TangentPlane& plane, float reach) {
  Search search{map};
  glm::dmat3 sums(0.0);
  glm::dvec3 turned(0.0);
  int met = 0;
  for (int i = 0; i < bend_probes; ++i) {
    const float turn = 2.0f * pi * float(i) / bend_probes, way = i % 2 ? reach : 0.5f * reach;
    const glm::vec2 off = way * glm::vec2(std::cos(turn), std::sin(turn));
    const MapPoint at = map.sample(search.on_tangent_plane(plane, off) - map.window.centre);
    if (at.kind == kind_closed) continue;
    ++met;
    const glm::dvec2 s(search.in_tangent_plane(plane, at.position - plane.at.position)),
        n(search.in_tangent_plane(plane, at.normal));
    const double weight = 1.0 / std::max(glm::dot(s, s), 1e-24);
    const glm::dvec3 across_u(s.x, s.y, 0.0), across_v(0.0, s.x, s.y);
    sums += weight * (glm::outerProduct(across_u, across_u) + glm::outerProduct(across_v, across_v));
    turned += weight * (n.x * across_u + n.y * across_v);
  }
  if (met < least_probes || map.window.extent == 0.0f)  // a rim is narrower than the way to the next start
    return search.surface_bend(plane, map.window.centre, window_breadth(map.window));
  return {glm::inverse(sums) * turned};
}

std::array<MapStart, start_count> starts_at(const ReflectorMap& map,
                                            const std::array<glm::vec3, start_count>& directions) {
  Search search{map};
  std::array<MapStart, start_count> starts;
  for (std::size_t i = 0; i < start_count; ++i)
    std::tie(starts[i].position, starts[i].normal) = map.surface(directions[i]);
  for (MapStart& start : starts) {
    float nearest = map.window.reach;
    for (const MapStart& other : starts)
      if (&other != &start) nearest = std::min(nearest, glm::distance(other.position, start.position));
    const glm::vec3 from_centre = start.position - map.window.centre;
    const auto plane = search.tangent_plane({start.position, start.normal, kind_surface},
                                            window_frame(map.window, from_centre, glm::vec3(0.0f)));
    start.u = plane.u;
    start.bend = bend_about(map, plane, bend_reach * std::max(nearest, 1e-3f * glm::length(from_centre)));
  }
  return starts;
}

}  // namespace

std::array<MapStart, start_count> spread_starts(const ReflectorMap& map, const ReflectorMesh& mesh,
                                                const ReflectorPatch& patch) {
  return starts_at(map, spread_directions(mesh, patch, map.window));
}

}  // namespace parvis::curved_reflectors
