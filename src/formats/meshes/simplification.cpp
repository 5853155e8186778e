#include "formats/meshes/simplification.h"

#include <meshoptimizer.h>

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
      result.positions.push_back(mesh.positions[old]);
      if (!mesh.normals.empty()) result.normals.push_back(mesh.normals[old]);
      if (!mesh.uvs.empty()) result.uvs.push_back(mesh.uvs[old]);
    }
    result.indices.push_back(new_index[old]);
  }
  return result;
}

}  // namespace

Mesh simplified(const Mesh& mesh, float max_error_m) {
  if (mesh.indices.empty()) return mesh;
  const float* positions = &mesh.positions.front().x;
  const float scale_m = meshopt_simplifyScale(positions, mesh.positions.size(), sizeof(glm::vec3));
  if (!(scale_m > 0.0f)) return mesh;
  std::vector<std::uint32_t> indices(mesh.indices.size());
  indices.resize(meshopt_simplify(indices.data(), mesh.indices.data(), mesh.indices.size(), positions,
                                  mesh.positions.size(), sizeof(glm::vec3), 0, max_error_m / scale_m,
                                  meshopt_SimplifyLockBorder, nullptr));
  return compacted(mesh, indices);
}

}  // namespace parvis::scene
