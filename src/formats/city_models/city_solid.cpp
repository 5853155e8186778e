#include "formats/city_models/city_solid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "formats/city_models/polygon_triangles.h"

namespace parvis::scene {
namespace {

using Corner = std::array<std::int64_t, 3>;

/// The corner in millimetres about `origin`: writers round to as much.
Corner corner_of(glm::dvec3 point, glm::dvec3 origin) {
  const glm::dvec3 mm = glm::round((point - origin) * 1000.0);
  return {std::int64_t(mm.x), std::int64_t(mm.y), std::int64_t(mm.z)};
}

}  // namespace

bool bound_a_solid(std::span<const CitySurface> surfaces) {
  constexpr double largest_m = 1e6;  // of a body; millimetres of what is beyond overflow
  if (surfaces.empty() || surfaces.front().rings.empty()) return false;
  const glm::dvec3 origin = surfaces.front().rings.front().front();
  std::map<Corner, int> corners;
  std::vector<std::pair<int, int>> edges, opposite_edges;
  double volume = 0.0;
  for (const CitySurface& surface : surfaces)
    for (const std::vector<glm::dvec3>& ring : surface.rings) {
      std::vector<int> indices;
      std::vector<glm::dvec3> about_origin;
      for (const glm::dvec3& point : ring) {
        if (!(glm::distance(point, origin) < largest_m)) return false;
        indices.push_back(corners.try_emplace(corner_of(point, origin), int(corners.size())).first->second);
        about_origin.push_back(point - origin);
      }
      for (std::size_t i = 0; i < indices.size(); ++i) {
        const int from = indices[i], to = indices[(i + 1) % indices.size()];
        if (from == to) continue;
        edges.emplace_back(from, to);
        opposite_edges.emplace_back(to, from);
      }
      // Green's theorem: a third of each ring's area times its distance; holes run the other way round.
      volume += glm::dot(newell_normal(about_origin), about_origin.front());
    }
  std::sort(edges.begin(), edges.end());
  std::sort(opposite_edges.begin(), opposite_edges.end());
  return edges == opposite_edges && volume > 0.0;
}

}  // namespace parvis::scene
