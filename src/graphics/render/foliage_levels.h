// Levels of detail of foliage: ever fewer, ever larger leaves (Cook, Halstead, Planck and Ryu 2007,
// "Stochastic Simplification of Aggregate Detail"). What merging edges cannot simplify, since leaves hang
// together nowhere.
#pragma once

#include <cstdint>
#include <vector>

#include "base/mesh.h"

namespace parvis::render {

inline constexpr int max_foliage_levels = 7;  ///< one leaf in 17

/// Foliage with fewer leaves: vertices of its own.
struct FoliageLevel {
  Mesh mesh;
  std::vector<std::uint32_t> vertices;  ///< of the finest mesh, one for each of `mesh`
  /// As the error of a surface (MeshLevel::error_m): a small, fixed share of the mean size of its leaves.
  float error_m = 0.0f;
};

/// Levels of detail of a mesh of many small pieces that share no vertices (leaves, sprays). Each keeps two
/// thirds of the pieces of the level before it, evenly over the order in which the mesh has them, enlarged
/// about their middles so that all levels have the area of the mesh. Empty where the pieces are few.
std::vector<FoliageLevel> foliage_levels(const Mesh& mesh);

/// Bytes that the levels of a mesh take at most.
std::uint64_t max_level_bytes(const Mesh& mesh);

}  // namespace parvis::render
