// A grown plant in flat arrays: leaves and twigs in an order of which every prefix is a good sample (Deussen,
// Colditz, Stamminger and Drettakis 2002, Interactive visualization of complex plant ecosystems, section 4;
// the thesis, section 5.3.3), and the wood as tubes, the thickest first.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "base/bounds.h"
#include "base/mesh.h"
#include "base/result.h"
#include "life/vegetation/plant_kind.h"

namespace parvis::vegetation {

/// The recipe from which a plant is grown; equal recipes grow equal plants on every machine.
struct PlantRecipe {
  const PlantKind* kind = nullptr;
  float height_m = 1.0f;
  float length_m = 1.0f;  ///< of a hedge, and of a side of a square of grass; trees have none
  std::uint64_t seed = 1;
};

/// One leaf, metres in the plant's frame.
struct Leaf {
  glm::vec3 foot;
  glm::vec3 along, normal;  ///< unit, perpendicular: to the tip, and off the upper side
  float length_m;
  float tint;      ///< 0..1: between the kind's two colours
  float openness;  ///< 0..1: share of the sky that the plant itself leaves open
};

/// Leaves close to each other.
struct LeafCluster {
  std::uint32_t first, count;  ///< in PlantShape::clustered
  Bounds bounds;
};
/// Leaves in a cluster: so few that the corners of their meshes have indices of 16 bits.
inline constexpr std::uint32_t max_cluster_leaves = 512;

/// A straight piece of wood, as a line.
struct Twig {
  glm::vec3 from, to;
  float radius_m;
  float openness;
  /// u / (2 radius), u uniform in 0..1 (priority sampling): from so many pixels per line's width and metre on
  /// it is drawn as a line. So the chance that it is among those drawn is its width over the line's, and the
  /// area of all is kept.
  float min_pixels_per_metre;
};

/// Triangles of a straight piece of wood: PlantShape::wood.indices from the end of the piece before it.
struct WoodPiece {
  float radius_m;
  std::uint32_t end;
};

/// A grown plant; its foot is at the origin, z is up.
struct PlantShape {
  PlantRecipe recipe;
  std::vector<Leaf> leaves;              ///< in prefix order
  std::vector<std::uint32_t> clustered;  ///< indices of leaves by cluster, ascending in each
  std::vector<LeafCluster> clusters;
  std::vector<Twig> twigs;           ///< ascending by min_pixels_per_metre: prefix order
  Mesh wood;                         ///< indices by pieces
  std::vector<float> wood_openness;  ///< one per point of `wood`
  std::vector<WoodPiece> pieces;     ///< the thickest first
  float mean_leaf_m = 0.0f;          ///< mean length
  float mean_leaf_area_m2 = 0.0f;    ///< of one side
  Bounds bounds;

  /// The kind as which it was grown.
  const PlantKind& kind() const { return *recipe.kind; }
  /// Number of triangles of the real geometry: full leaves and all wood.
  std::size_t triangle_count() const;
};

/// A tree has at most so many leaves; taller ones have larger leaves.
inline constexpr std::size_t max_tree_leaves = 150'000;
/// More leaves than this are not grown as one plant; a hedge or a lawn is divided.
inline constexpr std::size_t max_leaves = 400'000;
/// How many leaves grow from a recipe.
std::size_t leaf_count(const PlantRecipe& recipe);

/// Memory of the real geometry of such a plant and its points, bytes, estimated before it is grown.
std::uint64_t estimated_bytes(const PlantRecipe& recipe);

/// Grows a plant. `recipe` is within the bounds of its kind; its length is finite and positive.
PlantShape grow_plant(const PlantRecipe& recipe);

/// The triangles of all full leaves, in the order of `leaves`; uvs are places in leaf lengths, x across and y
/// along.
Mesh leaf_mesh(const PlantShape& shape);

}  // namespace parvis::vegetation
