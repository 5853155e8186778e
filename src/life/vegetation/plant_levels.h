// How much of a plant is drawn as what, by the size in which a view shows it.
#pragma once

#include "life/vegetation/plant_shape.h"

namespace parvis::vegetation {

/// Shares of a plant's leaves in prefix order: real geometry up to `full`, coarse leaves up to `simple`,
/// points up to `shown`; ascending, at most 1.
struct LeafShares {
  float full = 1.0f, simple = 1.0f, shown = 1.0f;

  bool has_triangles() const { return simple > 0.0f; }
};

/// Shares of the forms of leaves by the resolution, pixels per metre (infinity where the eye may be within).
/// All of them change continuously: a leaf changes from one form to the next when it has a few pixels, and
/// not all do at once.
LeafShares leaf_shares(const PlantShape& shape, float pixels_per_metre);

/// The last leaves that are shown grow into view over a band of this share; none where all are shown.
float fading_share(float shown);
/// Factor on the area of the leaves that are shown, so that it stays that of all.
float area_growth(float shown);

/// Width of the lines that stand for twigs, pixels.
inline constexpr float line_px = 2.0f;

/// How many twigs are lines, and up to which of the shape's pieces wood is made of triangles.
struct WoodShares {
  std::uint32_t pieces = 0;  ///< the thickest
  std::uint32_t twigs = 0;   ///< in prefix order
};
/// Shares of the forms of wood by the resolution, pixels per metre: wood as wide as a line has triangles.
WoodShares wood_shares(const PlantShape& shape, float pixels_per_metre);

/// Index in PlantShape::clustered behind the last leaf of a cluster that is within a share of all leaves.
std::uint32_t cluster_end(const PlantShape& shape, const LeafCluster& cluster, float share);

}  // namespace parvis::vegetation
