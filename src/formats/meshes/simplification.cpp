#include "formats/meshes/simplification.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace parvis::scene {
namespace {

/// The vertices that triangles use, in the order of their first use.
Mesh compacted(const Mesh& mesh, const std::vector<std::uint32_t>& indices) {
  constexpr std::uint32_t unused = ~0u;
  std::vector<std::uint32_t> new_index(mesh.positions.size(), unused);
  Mesh result;
  for (const std::uint32_t old : indices) {
    if (new_index[old] == unused) {
      new_index[old] = std::uint32_t(result.positions.size());
      append_vertex(result, mesh, old);
    }
    result.indices.push_back(new_index[old]);
  }
  return result;
}

/// The triangles that stay of these.
std::vector<std::uint32_t> simplified_indices(const std::vector<glm::vec3>& positions,
                                              const std::vector<std::uint32_t>& all, float max_error_m) {
  if (all.empty()) return all;
  const float* first = &positions.front().x;
  const float scale_m = meshopt_simplifyScale(first, positions.size(), sizeof(glm::vec3));
  if (!(scale_m > 0.0f)) return all;
  std::vector<std::uint32_t> indices(all.size());
  indices.resize(meshopt_simplify(indices.data(), all.data(), all.size(), first, positions.size(),
                                  sizeof(glm::vec3), 0, max_error_m / scale_m, meshopt_SimplifyLockBorder,
                                  nullptr));
  return indices;
}

/// The mesh with one vertex for those at one place whose normals differ by no crease.
Mesh without_needless_vertices(const Mesh& mesh, float max_crease_deg) {
  const float min_cosine = std::cos(glm::radians(max_crease_deg));
  std::map<std::array<float, 3>, std::vector<std::uint32_t>> at_place;
  std::vector<glm::vec3> sums;  // of normals, by the vertices of the result
  Mesh result;
  for (const std::uint32_t old : mesh.indices) {
    const glm::vec3 position = mesh.positions[old], normal = mesh.normals[old];
    std::vector<std::uint32_t>& here = at_place[{position.x, position.y, position.z}];
    const auto same = std::ranges::find_if(
        here, [&](std::uint32_t i) { return glm::dot(result.normals[i], normal) > min_cosine; });
    const std::uint32_t index = same != here.end() ? *same : std::uint32_t(result.positions.size());
    if (same == here.end()) {
      here.push_back(index);
      append_vertex(result, mesh, old);
      sums.emplace_back(0.0f);
    }
    sums[index] += normal;
    result.indices.push_back(index);
  }
  for (std::size_t i = 0; i < sums.size(); ++i) result.normals[i] = glm::normalize(sums[i]);
  return result;
}

}  // namespace

Mesh simplified(const Mesh& mesh, float max_error_m) {
  return compacted(mesh, simplified_indices(mesh.positions, mesh.indices, max_error_m));
}

void simplify_together(std::span<Mesh* const> meshes, float max_error_m, float max_crease_deg) {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> all;
  std::vector<std::size_t> ends;  // of the vertices of each mesh
  for (Mesh* mesh : meshes) {
    *mesh = without_needless_vertices(*mesh, max_crease_deg);
    for (const std::uint32_t index : mesh->indices) all.push_back(std::uint32_t(positions.size()) + index);
    positions.insert(positions.end(), mesh->positions.begin(), mesh->positions.end());
    ends.push_back(positions.size());
  }
  // Where two meshes touch, meshoptimizer moves the vertices of both: it knows them by their place.
  std::vector<std::vector<std::uint32_t>> kept(meshes.size());
  for (const std::uint32_t index : simplified_indices(positions, all, max_error_m)) {
    const auto mesh = std::size_t(std::ranges::upper_bound(ends, std::size_t(index)) - ends.begin());
    kept[mesh].push_back(index - std::uint32_t(mesh > 0 ? ends[mesh - 1] : 0));
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) *meshes[i] = compacted(*meshes[i], kept[i]);
}

}  // namespace parvis::scene
