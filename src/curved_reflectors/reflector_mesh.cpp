#include "curved_reflectors/reflector_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace parvis::curved_reflectors {
namespace {

constexpr float same_place = 1e-6f;   // of the mesh's size: vertices nearer than this are one
constexpr double least_area = 1e-12;  // of the size squared

using Triangle = std::array<std::uint32_t, 3>;

/// A number for each vertex, the same for vertices at one place.
std::vector<std::uint32_t> places_of(const Mesh& mesh, float tolerance) {
  std::map<std::tuple<long, long, long>, std::uint32_t> known;
  std::vector<std::uint32_t> places;
  for (const glm::vec3& p : mesh.positions) {
    const auto cell = [&](float x) { return std::lround(double(x) / double(tolerance)); };
    places.push_back(
        known.try_emplace({cell(p.x), cell(p.y), cell(p.z)}, std::uint32_t(known.size())).first->second);
  }
  return places;
}

glm::dvec3 area_vector(const Mesh& mesh, const Triangle& t) {
  const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  return 0.5 * glm::cross(b - a, c - a);
}

std::vector<Triangle> triangles_with_area(const Mesh& mesh, const std::vector<std::uint32_t>& places,
                                          double size) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Triangle t{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    const bool has_three_places =
        places[t[0]] != places[t[1]] && places[t[1]] != places[t[2]] && places[t[2]] != places[t[0]];
    if (has_three_places && glm::length(area_vector(mesh, t)) > least_area * size * size)
      triangles.push_back(t);
  }
  return triangles;
}

/// Sets what lies across each edge; returns how many edges have not exactly one other side.
std::size_t join(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& places,
                 std::vector<std::array<std::uint32_t, 3>>& neighbours) {
  using Side = std::pair<std::uint32_t, std::size_t>;  // triangle, edge
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>> edges;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e)
      edges[std::minmax(places[triangles[t][e]], places[triangles[t][(e + 1) % 3]])].emplace_back(
          std::uint32_t(t), e);
  neighbours.assign(triangles.size(), {no_triangle, no_triangle, no_triangle});
  std::size_t open = 0;
  for (const auto& [edge, sides] : edges) {
    if (sides.size() != 2) {
      ++open;
      continue;
    }
    neighbours[sides[0].first][sides[0].second] = sides[1].first;
    neighbours[sides[1].first][sides[1].second] = sides[0].first;
  }
  return open;
}

/// Do two neighbours run along their common edge in the same direction? Then one is turned over.
bool runs_along(const Triangle& a, std::size_t edge, const Triangle& b,
                const std::vector<std::uint32_t>& places) {
  for (std::size_t e = 0; e < 3; ++e)
    if (places[b[e]] == places[a[edge]] && places[b[(e + 1) % 3]] == places[a[(edge + 1) % 3]]) return true;
  return false;
}

/// Edges 0 and 2 change places, too.
void turn_over(Triangle& triangle, std::array<std::uint32_t, 3>& neighbours) {
  std::swap(triangle[1], triangle[2]);
  std::swap(neighbours[0], neighbours[2]);
}

/// Triangles that hang together, all turned as the first one is.
struct Piece {
  std::vector<std::uint32_t> triangles;
  std::size_t turned = 0;
  bool is_closed = true;
};

Piece turn_alike(std::uint32_t first, std::vector<Triangle>& triangles,
                 const std::vector<std::uint32_t>& places,
                 std::vector<std::array<std::uint32_t, 3>>& neighbours, std::vector<bool>& seen) {
  Piece piece;
  piece.triangles.push_back(first);
  seen[first] = true;
  for (std::size_t i = 0; i < piece.triangles.size(); ++i) {
    const std::uint32_t t = piece.triangles[i];
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t other = neighbours[t][e];
      if (other == no_triangle) piece.is_closed = false;
      if (other == no_triangle || seen[other]) continue;
      seen[other] = true;
      if (runs_along(triangles[t], e, triangles[other], places)) {
        turn_over(triangles[other], neighbours[other]);
        ++piece.turned;
      }
      piece.triangles.push_back(other);
    }
  }
  return piece;
}

/// Six times the space that a piece encloses, or how much its triangles face as its normals do.
double outwardness(const Mesh& mesh, const std::vector<Triangle>& triangles, const Piece& piece) {
  double volume = 0.0, agreement = 0.0;
  for (const std::uint32_t t : piece.triangles) {
    const glm::dvec3 area = area_vector(mesh, triangles[t]);
    volume += glm::dot(area, glm::dvec3(mesh.positions[triangles[t][0]]));
    for (const std::uint32_t vertex : triangles[t])
      agreement += glm::dot(area, glm::dvec3(mesh.normals[vertex]));
  }
  if (piece.is_closed) return volume;
  return agreement != 0.0 ? agreement : double(piece.triangles.size()) - 2.0 * double(piece.turned);
}

/// A vertex of its own for each corner whose normal is on another side than its neighbours' would be.
void write_mesh(const Mesh& mesh, const std::vector<Triangle>& triangles,
                const std::vector<std::uint32_t>& places, Mesh& made) {
  std::vector<glm::dvec3> smooth(mesh.positions.size());
  for (const Triangle& t : triangles)
    for (const std::uint32_t vertex : t) smooth[places[vertex]] += area_vector(mesh, t);
  std::map<std::pair<std::uint32_t, bool>, std::uint32_t> known;
  for (const Triangle& t : triangles) {
    const glm::dvec3 facing = glm::normalize(area_vector(mesh, t));
    for (const std::uint32_t vertex : t) {
      glm::dvec3 normal(mesh.normals[vertex]);
      if (!(glm::dot(normal, normal) > 1e-12)) normal = smooth[places[vertex]];
      if (!(glm::dot(normal, normal) > 1e-300)) normal = facing;
      const bool is_behind = glm::dot(normal, facing) < 0.0;
      const auto [entry, is_new] =
          known.try_emplace({vertex, is_behind}, std::uint32_t(made.positions.size()));
      made.indices.push_back(entry->second);
      if (!is_new) continue;
      made.positions.push_back(mesh.positions[vertex]);
      made.normals.emplace_back(glm::normalize(is_behind ? -normal : normal));
      made.uvs.push_back(mesh.uvs[vertex]);
    }
  }
}

}  // namespace

std::array<glm::vec3, 3> ReflectorMesh::corners(std::size_t triangle) const {
  const std::uint32_t* i = mesh.indices.data() + 3 * triangle;
  return {mesh.positions[i[0]], mesh.positions[i[1]], mesh.positions[i[2]]};
}

std::array<glm::vec3, 3> ReflectorMesh::normals(std::size_t triangle) const {
  const std::uint32_t* i = mesh.indices.data() + 3 * triangle;
  return {mesh.normals[i[0]], mesh.normals[i[1]], mesh.normals[i[2]]};
}

Result<ReflectorMesh> reflector_mesh(const Mesh& mesh, const std::string& name) {
  if (Status status = check(mesh, name); !status) return status.errors();
  ReflectorMesh made;
  const float size = glm::length(mesh.bounds().size());
  const std::vector<std::uint32_t> places = places_of(mesh, same_place * size);
  std::vector<Triangle> triangles = triangles_with_area(mesh, places, double(size));
  if (triangles.empty())
    return error("{}: none of its {} triangles has an area; a reflector needs a surface", name,
                 mesh.triangle_count());
  made.dropped_triangles = mesh.triangle_count() - triangles.size();
  made.open_edges = join(triangles, places, made.neighbours);

  std::vector<bool> seen(triangles.size());
  for (std::uint32_t first = 0; first < triangles.size(); ++first) {
    if (seen[first]) continue;
    const Piece piece = turn_alike(first, triangles, places, made.neighbours, seen);
    const bool is_inside_out = outwardness(mesh, triangles, piece) < 0.0;
    made.turned_triangles += is_inside_out ? piece.triangles.size() - piece.turned : piece.turned;
    if (is_inside_out)
      for (const std::uint32_t t : piece.triangles) turn_over(triangles[t], made.neighbours[t]);
  }
  write_mesh(mesh, triangles, places, made.mesh);
  return made;
}

}  // namespace parvis::curved_reflectors
