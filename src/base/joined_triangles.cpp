#include "base/joined_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace parvis {
namespace {

constexpr double same_place = 1e-6;  // of the mesh's size: vertices nearer than this are one
/// Of the greatest coordinate: so are those nearer than a few of the steps that numbers have there.
constexpr double few_steps = 4.0 * std::numeric_limits<float>::epsilon();
constexpr double tolerances_a_cell = 8.0;
constexpr double least_area = 1e-12;  // of the size squared

using Triangle = std::array<std::uint32_t, 3>;

/// Vertices by where they are: cells of several tolerances, so that few places lie beside a border.
class Places {
 public:
  Places(const Bounds& bounds, double tolerance) : corner_(bounds.min), tolerance_(tolerance) {}

  /// The number of the place that a point is at; a new one, if it is near none.
  std::uint32_t at(glm::vec3 position) {
    const glm::dvec3 point = glm::dvec3(position) - corner_;  // so that cells have small numbers
    const glm::dvec3 low = point - tolerance_, high = point + tolerance_;
    const Cell first = cell_of(low), last = cell_of(high);
    for (long x = first[0]; x <= last[0]; ++x)
      for (long y = first[1]; y <= last[1]; ++y)
        for (long z = first[2]; z <= last[2]; ++z)
          if (const auto cell = cells_.find({x, y, z}); cell != cells_.end())
            for (const std::uint32_t place : cell->second)
              if (glm::distance(points_[place], point) <= tolerance_) return place;
    points_.push_back(point);
    cells_[cell_of(point)].push_back(std::uint32_t(points_.size() - 1));
    return std::uint32_t(points_.size() - 1);
  }

 private:
  using Cell = std::array<long, 3>;

  Cell cell_of(glm::dvec3 point) const {
    const auto along = [&](double x) { return long(std::floor(x / (tolerances_a_cell * tolerance_))); };
    return {along(point.x), along(point.y), along(point.z)};
  }

  glm::dvec3 corner_;
  double tolerance_;
  std::vector<glm::dvec3> points_;
  std::map<Cell, std::vector<std::uint32_t>> cells_;
};

/// 0 if nothing has an extent, or it is beyond all numbers: then nothing has an area.
double tolerance_of(const Bounds& bounds) {
  const float size = glm::length(bounds.size());
  if (!(size > 0.0f) || !std::isfinite(size)) return 0.0;
  const glm::vec3 far = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  return std::max(same_place * double(size), few_steps * double(std::max({far.x, far.y, far.z})));
}

/// Of each vertex.
std::vector<std::uint32_t> places_of(const Mesh& mesh, const Bounds& bounds, double tolerance) {
  std::vector<std::uint32_t> all;
  all.reserve(mesh.positions.size());
  Places places(bounds, tolerance);
  for (const glm::vec3& position : mesh.positions) all.push_back(places.at(position));
  return all;
}

bool has_three_places(const Triangle& t, const std::vector<std::uint32_t>& places) {
  return places[t[0]] != places[t[1]] && places[t[1]] != places[t[2]] && places[t[2]] != places[t[0]];
}

double area_of(const Mesh& mesh, const Triangle& t) {
  const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

void take_triangles_with_area(const Mesh& mesh, double size, JoinedTriangles& joined) {
  const std::vector<std::uint32_t>& places = joined.places;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Triangle t{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    if (!has_three_places(t, places) || area_of(mesh, t) <= least_area * size * size) continue;
    joined.triangles.push_back(t);
    joined.numbers.push_back(std::uint32_t(i / 3));
  }
}

/// Sets what lies across each edge.
void join(JoinedTriangles& joined) {
  using Side = std::pair<std::uint32_t, std::size_t>;  // triangle, edge
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>> edges;
  for (std::size_t t = 0; t < joined.triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e)
      edges[std::minmax(joined.places[joined.triangles[t][e]],
                        joined.places[joined.triangles[t][(e + 1) % 3]])]
          .emplace_back(std::uint32_t(t), e);
  joined.neighbours.assign(joined.triangles.size(), {no_triangle, no_triangle, no_triangle});
  for (const auto& [edge, sides] : edges) {
    if (sides.size() != 2) {
      ++joined.open_edges;
      continue;
    }
    joined.neighbours[sides[0].first][sides[0].second] = sides[1].first;
    joined.neighbours[sides[1].first][sides[1].second] = sides[0].first;
  }
}

}  // namespace

JoinedTriangles joined_triangles(const Mesh& mesh) {
  const Bounds bounds = mesh.bounds();
  const double tolerance = tolerance_of(bounds);
  JoinedTriangles joined;
  if (tolerance == 0.0) {
    joined.places.assign(mesh.positions.size(), 0);
    return joined;
  }
  joined.places = places_of(mesh, bounds, tolerance);
  take_triangles_with_area(mesh, double(glm::length(bounds.size())), joined);
  join(joined);
  return joined;
}

std::vector<MeshPiece> pieces(const JoinedTriangles& joined) {
  std::vector<MeshPiece> all;
  std::vector<bool> seen(joined.triangles.size());
  for (std::uint32_t first = 0; first < joined.triangles.size(); ++first) {
    if (seen[first]) continue;
    MeshPiece& piece = all.emplace_back();
    piece.triangles.push_back(first);
    seen[first] = true;
    for (std::size_t i = 0; i < piece.triangles.size(); ++i)
      for (const std::uint32_t other : joined.neighbours[piece.triangles[i]]) {
        piece.is_closed &= other != no_triangle;
        if (other == no_triangle || seen[other]) continue;
        seen[other] = true;
        piece.triangles.push_back(other);
      }
  }
  return all;
}

}  // namespace parvis
