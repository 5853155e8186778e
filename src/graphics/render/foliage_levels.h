// Levels of detail of foliage: ever fewer, ever larger leaves (Cook, Halstead, Planck and Ryu 2007,
// "Stochastic Simplification of Aggregate Detail"). What merging edges cannot simplify, since leaves hang
// together nowhere.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/mesh.h"

namespace parvis::render {

inline constexpr int max_foliage_levels = 7;  ///< one leaf in 17

/// Foliage with fewer leaves: vertices of its own.
struct FoliageLevel {
  Mesh mesh;
  std::vector<std::uint32_t> vertices;  ///< of the finest mesh, one for each of `mesh`
  /// The error as that of a surface (MeshLevel::error_m): a small, fixed fraction of the mean size of its
  /// leaves.
  float error_m = 0.0f;
};

/// Levels of detail of a mesh of many small pieces that share no vertices (leaves, sprays). Where a crown
/// hides a third of its pieces or more (`max_seen` gives, by vertex, what of it is seen from outside at
/// most: scene::LeafOpenness; empty: all), the first level leaves those out and changes no other. Each
/// further level keeps two thirds of the pieces of the one before it, evenly over the order in which the mesh
/// has them, enlarged about their middles so that these levels have the same area. Empty where the pieces are
/// few.
std::vector<FoliageLevel> foliage_levels(const Mesh& mesh, std::span<const float> max_seen = {});

/// Bytes that the levels of a mesh take at most.
std::uint64_t max_level_bytes(const Mesh& mesh);

}  // namespace parvis::render
