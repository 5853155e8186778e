#include "graphics/render/mesh_levels.h"

#include <meshoptimizer.h>

#include <algorithm>

namespace parvis::render {
namespace {

constexpr std::size_t min_triangles = 64;  // below it a call costs more than its triangles
// Long edges tell less of normals and textures, even where the surface stays in its place.
constexpr float error_of_edge = 0.005f;

float mean_edge_m(const Mesh& mesh, const std::vector<std::uint32_t>& indices) {
  double sum_m = 0.0;
  for (std::size_t i = 0; i < indices.size(); i += 3)
    for (std::size_t side = 0; side < 3; ++side)
      sum_m += double(
          glm::distance(mesh.positions[indices[i + side]], mesh.positions[indices[i + (side + 1) % 3]]));
  return float(sum_m / double(indices.size()));
}

}  // namespace

std::vector<MeshLevel> coarser_levels(const Mesh& mesh) {
  std::vector<MeshLevel> levels;
  if (mesh.triangle_count() < 2 * min_triangles) return levels;
  const float* positions = &mesh.positions.front().x;
  const float scale_m = meshopt_simplifyScale(positions, mesh.positions.size(), sizeof(glm::vec3));
  std::size_t finer = mesh.indices.size();
  while (levels.size() < std::size_t(max_mesh_levels) && finer >= 6 * min_triangles) {
    MeshLevel level{std::vector<std::uint32_t>(mesh.indices.size()), 0.0f};
    const std::size_t wanted = finer / 6 * 3;
    level.indices.resize(meshopt_simplify(level.indices.data(), mesh.indices.data(), mesh.indices.size(),
                                          positions, mesh.positions.size(), sizeof(glm::vec3), wanted, 1.0f,
                                          0, &level.error_m));
    if (level.indices.empty() || level.indices.size() > finer / 4 * 3) break;  // no more can be left out
    finer = level.indices.size();
    level.error_m = std::max(scale_m * level.error_m, error_of_edge * mean_edge_m(mesh, level.indices));
    levels.push_back(std::move(level));
  }
  return levels;
}

}  // namespace parvis::render
