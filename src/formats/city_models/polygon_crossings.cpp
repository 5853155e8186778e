#include "formats/city_models/polygon_crossings.h"

#include <algorithm>
#include <cmath>

namespace parvis::scene {
namespace {

/// Pairs of edges that overlap along the axis of the sweep: the tessellator's list of active edges is walked
/// as often. An outline of 100,000 points has some millions.
constexpr std::size_t max_pairs = 100'000'000;

struct Edge {
  glm::dvec2 a, b;  ///< a.x <= b.x
};

/// The plan whose axes are the two along which the surface is least foreshortened, the tessellator's sweep
/// first.
glm::dvec2 in_plan(glm::dvec3 p, glm::dvec3 normal) {
  const glm::dvec3 size = glm::abs(normal);
  if (size.z >= size.x && size.z >= size.y) return {p.x, p.y};
  return size.y >= size.x ? glm::dvec2(p.z, p.x) : glm::dvec2(p.y, p.z);
}

double side(const Edge& edge, glm::dvec2 p) {
  const glm::dvec2 along = edge.b - edge.a, away = p - edge.a;
  return along.x * away.y - along.y * away.x;
}

/// Whether two edges on one line have more than a point in common; `s` begins first along the sweep.
bool overlap(const Edge& s, const Edge& t) {
  const glm::dvec2 along = s.b - s.a;
  const double length2 = glm::dot(along, along);
  if (!(length2 > 0.0)) return false;
  const double from = glm::dot(t.a - s.a, along), to = glm::dot(t.b - s.a, along);
  return std::min(std::max(from, to), length2) > std::max(std::min(from, to), 0.0);
}

bool cross(const Edge& s, const Edge& t) {
  const double a = side(s, t.a), b = side(s, t.b), c = side(t, s.a), d = side(t, s.b);
  if (a == 0.0 && b == 0.0) return overlap(s, t);
  return ((a > 0.0) != (b > 0.0)) && ((c > 0.0) != (d > 0.0)) && a != 0.0 && b != 0.0 && c != 0.0 && d != 0.0;
}

std::vector<Edge> edges_of(const std::vector<std::vector<glm::dvec3>>& rings, glm::dvec3 normal) {
  std::vector<Edge> edges;
  for (const std::vector<glm::dvec3>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2 a = in_plan(ring[i], normal), b = in_plan(ring[(i + 1) % ring.size()], normal);
      edges.push_back(a.x <= b.x ? Edge{a, b} : Edge{b, a});
    }
  std::ranges::sort(edges, {}, [](const Edge& edge) { return edge.a.x; });
  return edges;
}

}  // namespace

bool can_be_triangulated(const std::vector<std::vector<glm::dvec3>>& rings, glm::dvec3 normal) {
  std::size_t points = 0;
  for (const std::vector<glm::dvec3>& ring : rings) points += ring.size();
  if (points * points / 2 <= max_edge_crossings) return true;  // whatever they do
  if (points * rings.size() > max_ring_points) return false;
  const std::vector<Edge> edges = edges_of(rings, normal);
  std::size_t crossings = 0, pairs = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Edge& s = edges[i];
    const double low = std::min(s.a.y, s.b.y), high = std::max(s.a.y, s.b.y);
    for (std::size_t j = i + 1; j < edges.size() && edges[j].a.x <= s.b.x; ++j) {
      if (++pairs > max_pairs) return false;
      const Edge& t = edges[j];
      if (std::max(t.a.y, t.b.y) < low || std::min(t.a.y, t.b.y) > high) continue;
      if (cross(s, t) && ++crossings > max_edge_crossings) return false;
    }
  }
  return true;
}

}  // namespace parvis::scene
