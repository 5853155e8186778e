#include "render/mesh_levels.h"

#include <meshoptimizer.h>

namespace parvis::render {
namespace {

constexpr std::size_t least_triangles = 64;  // below it a call costs more than its triangles
constexpr int most_levels = 7;               // one in 128: a car of 100 triangles

}  // namespace

std::vector<MeshLevel> coarser_levels(const Mesh& mesh) {
  std::vector<MeshLevel> levels;
  if (mesh.triangle_count() < 2 * least_triangles) return levels;
  const float* positions = &mesh.positions.front().x;
  const float scale_m = meshopt_simplifyScale(positions, mesh.positions.size(), sizeof(glm::vec3));
  std::size_t finer = mesh.indices.size();
  while (levels.size() < most_levels && finer >= 6 * least_triangles) {
    MeshLevel level{std::vector<std::uint32_t>(mesh.indices.size()), 0.0f};
    const std::size_t wanted = finer / 6 * 3;
    level.indices.resize(meshopt_simplify(level.indices.data(), mesh.indices.data(), mesh.indices.size(),
                                          positions, mesh.positions.size(), sizeof(glm::vec3), wanted, 1.0f,
                                          0, &level.error_m));
    if (level.indices.empty() || level.indices.size() > finer / 4 * 3) break;  // no more can be left out
    finer = level.indices.size();
    level.error_m *= scale_m;
    levels.push_back(std::move(level));
  }
  return levels;
}

}  // namespace parvis::render
