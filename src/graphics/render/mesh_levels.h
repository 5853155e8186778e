// Levels of detail of a mesh (Garland and Heckbert 1997, quadric errors): the same vertices, ever fewer
// triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "base/mesh.h"

namespace parvis::render {

inline constexpr int max_mesh_levels = 7;  ///< one triangle in 128

/// A mesh simplified over its own vertices.
struct MeshLevel {
  std::vector<std::uint32_t> indices;
  float error_m;  ///< estimated distance between the two surfaces; locally up to three times as large
};

/// Levels of detail, each with half (at most three quarters) of the triangles of the level before it; empty
/// where the mesh has few triangles.
std::vector<MeshLevel> coarser_levels(const Mesh& mesh);

}  // namespace parvis::render
