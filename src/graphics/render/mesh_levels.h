// Levels of detail of a mesh (Garland and Heckbert 1997, quadric errors): the same vertices, ever fewer
// triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "base/mesh.h"

namespace parvis::render {

inline constexpr int max_mesh_levels = 7;  ///< one triangle in 128

struct MeshLevel {
  std::vector<std::uint32_t> indices;
  float error_m;  ///< about how far its surface lies from the mesh's; in places up to three times that
};

/// Coarser and coarser, each of half the triangles of the one before or at most three quarters; none where
/// the mesh has few triangles.
std::vector<MeshLevel> coarser_levels(const Mesh& mesh);

}  // namespace parvis::render
