#include "base/joined_triangles.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace parvis {
namespace {

constexpr float same_place = 1e-6f;  // of the mesh's size: vertices nearer than this are one
constexpr double tolerances_a_cell = 8.0;
constexpr double least_area = 1e-12;  // of the size squared

using Triangle = std::array<std::uint32_t, 3>;

/// Vertices by where they are: cells of several tolerances, so that few places lie beside a border.
class Places {
 public:
  explicit Places(float tolerance) : tolerance_(double(tolerance)) {}

  /// The number of the place that a point is at; a new one, if it is near none.
  std::uint32_t at(glm::dvec3 point) {
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

  double tolerance_;
  std::vector<glm::dvec3> points_;
  std::map<Cell, std::vector<std::uint32_t>> cells_;
};

double area_of(const Mesh& mesh, const Triangle& t) {
  const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

void take_triangles_with_area(const Mesh& mesh, double size, JoinedTriangles& joined) {
  const std::vector<std::uint32_t>& places = joined.places;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Triangle t{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    const bool has_three_places =
        places[t[0]] != places[t[1]] && places[t[1]] != places[t[2]] && places[t[2]] != places[t[0]];
    if (!has_three_places || area_of(mesh, t) <= least_area * size * size) continue;
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
  const float size = glm::length(mesh.bounds().size());
  JoinedTriangles joined;
  if (!(size > 0.0f) || !std::isfinite(size)) {  // nothing has an area, or it is beyond all numbers
    joined.places.assign(mesh.positions.size(), 0);
    return joined;
  }
  Places places(same_place * size);
  joined.places.reserve(mesh.positions.size());
  for (const glm::vec3& position : mesh.positions) joined.places.push_back(places.at(position));
  take_triangles_with_area(mesh, double(size), joined);
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
