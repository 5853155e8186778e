#include "reflections/reflector_maps/map_starts.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <tuple>
#include <vector>

#include "reflections/reflection_search/reflection_search.h"
#include "reflections/reflector_maps/reflector_map.h"

namespace parvis::reflector_maps {
using namespace reflection_search;
namespace {

using Search = ReflectionSearch<ReflectorMap>;

constexpr float middle_share = 0.3f;                  // of a band's breadth, in which searches begin
constexpr int curvature_probes = 16, min_probes = 4;  // about a start
constexpr float curvature_reach = 0.6f;               // of the distance to the next start

/// Directions to triangles of a patch, where the map says what the surface is; of a rim, to those along its
/// middle: beside its edges normals point away from most that it shows.
std::vector<glm::vec3> start_directions(const ReflectorMap& map, const ReflectorMesh& mesh,
                                        const ReflectorPatch& patch) {
  const MapWindow& window = map.window;
  std::vector<glm::vec3> all, on_surface, in_middle;
  for (const std::uint32_t t : patch.triangles) {
    const auto [a, b, c] = mesh.corners(t);
    const glm::vec3 direction = glm::normalize(a + b + c - 3.0f * patch.centre);
    all.push_back(direction);
    if (map.surface_kind(direction) != kind_surface) continue;
    on_surface.push_back(direction);
    const float off_axis = std::acos(glm::clamp(glm::dot(direction, window.axes[2]), -1.0f, 1.0f));
    const float off_middle = off_axis - window.band.y - 0.5f * window.band.z;
    if (std::abs(off_middle) < 0.5f * middle_share * window.band.z) in_middle.push_back(direction);
  }
  return !in_middle.empty() ? in_middle : !on_surface.empty() ? on_surface : all;
}

/// Directions to triangles of the patch, the first near its middle, each of the others as far as can be from
/// those before.
std::vector<glm::vec3> spread_directions(const ReflectorMap& map, const ReflectorMesh& mesh,
                                         const ReflectorPatch& patch) {
  const glm::vec3 middle = map.window.axes[2];
  const std::vector<glm::vec3> directions = start_directions(map, mesh, patch);
  std::vector<glm::vec3> starts(start_count);
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

/// The same in another order: beside each of the first 16 as many of the others, the nearest pairs first.
std::vector<glm::vec3> side_by_side(const std::vector<glm::vec3>& directions) {
  std::vector<std::tuple<float, std::size_t, std::size_t>> pairs;
  for (std::size_t first = 0; first < layer_start_count; ++first)
    for (std::size_t other = layer_start_count; other < start_count; ++other)
      pairs.emplace_back(-glm::dot(directions[first], directions[other]), first, other);
  std::sort(pairs.begin(), pairs.end());
  std::vector<glm::vec3> ordered = directions;
  std::vector<char> is_taken(start_count);
  std::array<std::size_t, layer_start_count> beside{};
  for (const auto& [apart, first, other] : pairs) {
    if (is_taken[other] || beside[first] == starts_beside) continue;
    is_taken[other] = true;
    ordered[layer_start_count + starts_beside * first + beside[first]++] = directions[other];
  }
  return ordered;
}

/// Curvature of the surface around a start, as far as `reach`: the symmetric matrix (uu, uv, vv) by which,
/// over rings of probes, the normal's turn is best told from the way (least squares).
glm::vec3 curvature_around(const ReflectorMap& map, const Search::TangentPlane& plane, float reach) {
  Search search{map};
  glm::dmat3 sums(0.0);
  glm::dvec3 turned(0.0);
  int met = 0;
  for (int i = 0; i < curvature_probes; ++i) {
    const float turn = 2.0f * glm::pi<float>() * float(i) / curvature_probes,
                probe_distance = i % 2 ? reach : 0.5f * reach;
    const glm::vec2 off = probe_distance * glm::vec2(std::cos(turn), std::sin(turn));
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
  if (met < min_probes || map.window.extent == 0.0f)  // a rim is narrower than the way to the next start
    return search.surface_curvature(plane, map.window.centre, window_breadth(map.window));
  return {glm::inverse(sums) * turned};
}

std::vector<MapStart> starts_at(const ReflectorMap& map, const std::vector<glm::vec3>& directions) {
  Search search{map};
  std::vector<MapStart> starts(start_count);
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
    start.curvature =
        curvature_around(map, plane, curvature_reach * std::max(nearest, 1e-3f * glm::length(from_centre)));
  }
  return starts;
}

}  // namespace

void MapStarts::set(std::size_t i, const MapStart& start) {
  std::size_t number = 0;
  for (const glm::vec3& value : {start.position, start.normal, start.u, start.curvature})
    for (int axis = 0; axis < 3; ++axis) numbers_[number++][i] = value[axis];
}

MapStarts spread_starts(const ReflectorMap& map, const ReflectorMesh& mesh, const ReflectorPatch& patch) {
  const std::vector<MapStart> starts = starts_at(map, side_by_side(spread_directions(map, mesh, patch)));
  MapStarts by_number;
  for (std::size_t i = 0; i < start_count; ++i) by_number.set(i, starts[i]);
  return by_number;
}

}  // namespace parvis::reflector_maps
