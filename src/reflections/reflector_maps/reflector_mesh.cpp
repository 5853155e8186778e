#include "reflections/reflector_maps/reflector_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace parvis::reflector_maps {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

glm::dvec3 area_vector(const Mesh& mesh, const Triangle& t) {
  const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  return 0.5 * glm::cross(b - a, c - a);
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

/// Turns the triangles of a piece as its first one is; returns how many were turned.
std::size_t turn_alike(const MeshPiece& piece, JoinedTriangles& joined, std::vector<bool>& seen) {
  std::size_t turned = 0;
  seen[piece.triangles.front()] = true;
  for (const std::uint32_t t : piece.triangles)  // each after one that it touches
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t other = joined.neighbours[t][e];
      if (other == no_triangle || seen[other]) continue;
      seen[other] = true;
      if (!runs_along(joined.triangles[t], e, joined.triangles[other], joined.places)) continue;
      turn_over(joined.triangles[other], joined.neighbours[other]);
      ++turned;
    }
  return turned;
}

/// Six times the space that a piece encloses, or how much its triangles face as its normals do.
double outwardness(const Mesh& mesh, const std::vector<Triangle>& triangles, const MeshPiece& piece,
                   std::size_t turned) {
  double volume = 0.0, agreement = 0.0;
  for (const std::uint32_t t : piece.triangles) {
    const glm::dvec3 area = area_vector(mesh, triangles[t]);
    volume += glm::dot(area, glm::dvec3(mesh.positions[triangles[t][0]]));
    for (const std::uint32_t vertex : triangles[t])
      agreement += glm::dot(area, glm::dvec3(mesh.normals[vertex]));
  }
  if (piece.is_closed) return volume;
  return agreement != 0.0 ? agreement : double(piece.triangles.size()) - 2.0 * double(turned);
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
  JoinedTriangles joined = joined_triangles(mesh);
  if (joined.triangles.empty())
    return error("{}: none of its {} triangles has an area; a reflector needs a surface", name,
                 mesh.triangle_count());
  made.dropped_triangles = mesh.triangle_count() - joined.triangles.size();
  made.open_edges = joined.open_edges;

  std::vector<bool> seen(joined.triangles.size());
  for (const MeshPiece& piece : pieces(joined)) {
    const std::size_t turned = turn_alike(piece, joined, seen);
    const bool is_inside_out = outwardness(mesh, joined.triangles, piece, turned) < 0.0;
    made.turned_triangles += is_inside_out ? piece.triangles.size() - turned : turned;
    if (is_inside_out)
      for (const std::uint32_t t : piece.triangles) turn_over(joined.triangles[t], joined.neighbours[t]);
  }
  made.neighbours = std::move(joined.neighbours);
  write_mesh(mesh, joined.triangles, joined.places, made.mesh);
  return made;
}

}  // namespace parvis::reflector_maps
