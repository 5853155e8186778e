#include "capture/facades/layer_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

#include "base/bounds.h"
#include "base/disjoint_sets.h"
#include "base/joined_triangles.h"

namespace parvis::facades {
namespace {

/// Cosine between normals of triangles that form one face, and their distance from its plane over the model's
/// size: what 32-bit positions lose.
constexpr double min_coplanar_cosine = 1.0 - 1e-6;
constexpr double max_plane_distance = 1e-5;

glm::dvec3 scaled_normal(const std::array<glm::dvec3, 3>& corners) {
  return glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
}

bool is_degenerate(const std::array<glm::dvec3, 3>& corners) {
  double longest = 0.0;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, glm::distance(corners[k], corners[(k + 1) % 3]));
  return glm::length(scaled_normal(corners)) <= 1e-12 * longest * longest;
}

/// The three positions in an order that does not depend on how the triangle runs.
using SortedCorners = std::array<double, 9>;
SortedCorners sorted_corners(std::array<glm::dvec3, 3> corners) {
  const auto less = [](const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::sort(corners.begin(), corners.end(), less);
  SortedCorners place;
  for (int k = 0; k < 9; ++k) place[std::size_t(k)] = corners[std::size_t(k / 3)][k % 3];
  return place;
}

bool bounds_a_body(const Mesh& mesh) {
  const std::vector<MeshShell> parts = shells(mesh);
  return !parts.empty() && std::ranges::all_of(parts, [](const MeshShell& shell) {
    return shell.is_closed && shell.volume > 0.0;
  });
}

/// Gives the triangles [first, end) of one object their faces: coplanar neighbours over an edge.
void assign_faces(LayerModel& model, std::size_t first, double size) {
  using Edge = std::array<double, 6>;
  std::map<Edge, std::vector<std::uint32_t>> edges;
  DisjointSets sets(model.triangles.size() - first);
  const auto as_tuple = [](const glm::dvec3& p) { return std::tie(p.x, p.y, p.z); };
  for (std::size_t t = first; t < model.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      glm::dvec3 a = model.triangles[t].corners[k], b = model.triangles[t].corners[(k + 1) % 3];
      if (as_tuple(b) < as_tuple(a)) std::swap(a, b);
      edges[Edge{a.x, a.y, a.z, b.x, b.y, b.z}].push_back(std::uint32_t(t - first));
    }
  for (const auto& [edge, around] : edges) {
    if (around.size() != 2) continue;  // where more meet, which of them go on into which is anybody's guess
    // Both against the root's plane, else a finely divided cylinder becomes one face step by step.
    const auto& a = model.triangles[first + sets.root(around[0])].corners;
    const auto& b = model.triangles[first + around[1]].corners;
    const glm::dvec3 normal = glm::normalize(scaled_normal(a));
    const glm::dvec3 root_b =
        glm::normalize(scaled_normal(model.triangles[first + sets.root(around[1])].corners));
    const bool is_coplanar = glm::dot(normal, glm::normalize(scaled_normal(b))) >= min_coplanar_cosine &&
                             glm::dot(normal, root_b) >= min_coplanar_cosine &&
                             std::ranges::all_of(b, [&](const glm::dvec3& corner) {
                               return std::abs(glm::dot(normal, corner - a[0])) <= max_plane_distance * size;
                             });
    if (is_coplanar) sets.join(around[1], around[0]);
  }
  std::unordered_map<std::size_t, std::uint32_t> faces;
  for (std::size_t t = first; t < model.triangles.size(); ++t) {
    const auto [found, is_new] = faces.try_emplace(sets.root(t - first), model.face_count);
    if (is_new) ++model.face_count;
    model.triangles[t].face = found->second;
  }
}

}  // namespace

PlaneFrame frame_of(const LayerTriangle& triangle) {
  const auto& c = triangle.corners;
  const glm::dvec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
  const glm::dvec3 up = std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(up, normal));
  return {c[0], u, glm::cross(normal, u), normal};
}

double LayerModel::size() const {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const LayerTriangle& triangle : triangles)
    for (const glm::dvec3& corner : triangle.corners)
      low = glm::min(low, corner), high = glm::max(high, corner);
  return triangles.empty() ? 0.0 : glm::length(high - low);
}

Result<LayerModelResult> layer_model(const std::vector<NamedMesh>& meshes) {
  LayerModelResult result;
  LayerModel& model = result.model;
  Bounds bounds;
  for (const NamedMesh& named : meshes) {
    if (const Status sound = check(named.mesh, named.name); !sound) return sound.errors();
    bounds.add(named.mesh.bounds());
  }
  std::map<SortedCorners, std::uint32_t> places;  // of the triangles so far: their object
  for (const NamedMesh& named : meshes) {
    const std::size_t first = model.triangles.size();
    const std::uint32_t object = std::uint32_t(model.objects.size());
    std::size_t degenerate = 0, twice = 0;
    std::uint32_t other = object;
    for (std::size_t t = 0; t < named.mesh.triangle_count(); ++t) {
      LayerTriangle triangle;
      for (std::size_t k = 0; k < 3; ++k)
        triangle.corners[k] = named.mesh.positions[named.mesh.indices[3 * t + k]];
      if (is_degenerate(triangle.corners)) {
        ++degenerate;
        continue;
      }
      const auto [found, is_new] = places.try_emplace(sorted_corners(triangle.corners), object);
      if (!is_new) {
        ++twice, other = found->second;
        continue;
      }
      triangle.object = object;
      model.triangles.push_back(triangle);
    }
    const bool is_backdrop = named.name == backdrop_name;
    model.objects.push_back({named.name, !is_backdrop && bounds_a_body(named.mesh), is_backdrop, false});
    if (degenerate)
      result.warnings.push_back(
          error("object \"{}\": {} triangles without area were left out", named.name, degenerate));
    if (twice)
      result.warnings.push_back(
          error("object \"{}\": {} triangles lie exactly on triangles of \"{}\" and were left out; remove "
                "one of the two "
                "copies from the model",
                named.name, twice, model.objects[other].name));
    const std::uint32_t faces_before = model.face_count;
    assign_faces(model, first, 2.0 * bounds.radius());
    model.objects.back().is_dense = model.face_count - faces_before > max_faces_in_layers;
  }
  for (std::size_t t = 0; t < model.triangles.size(); ++t) model.triangles[t].source = std::uint32_t(t);
  model.source_count = std::uint32_t(model.triangles.size());
  if (model.triangles.empty()) return error("the model has no triangle with an area; expected at least one");
  return result;
}

}  // namespace parvis::facades
