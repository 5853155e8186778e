// The outline of a tree in horizontal slices, as foresters take crown volume from laser scans: the convex
// hull of each slice (Fernandez-Sarria and others 2013, Computers and Electronics in Agriculture 90, compare
// it with the hull of the whole crown, with sections and with voxels). A hull depends on where the tree ends
// and not on how densely it is sampled, so that a mesh and a volume of cells are measured alike.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "capture/trees/tree_volume.h"

namespace parvis::trees {

/// A horizontal slice of a tree, by how far it reaches in each of 72 directions from the vertical axis.
class TreeSlice {
 public:
  static constexpr int directions = 72;
  /// The direction of an index, unit, east at index 0.
  static glm::vec2 direction(int index);

  TreeSlice() { reach_m_.fill(nothing); }
  /// Widens the slice to reach so far, metres, in a direction.
  void widen(int direction, float reach_m);
  void add(glm::vec2 point);         ///< a point of the tree, from above
  void add(const TreeSlice& other);  ///< all that another slice covers
  bool empty() const;                ///< nothing of the tree in some direction
  float mean_width_m() const;        ///< mean extent over the directions; 0 where empty
  float hull_area_m2() const;        ///< of the convex hull; 0 where empty

 private:
  static constexpr float nothing = -1e30f;
  std::array<float, directions> reach_m_;
};

/// A tree from its foot to its top in slices of equal height.
struct TreeOutline {
  static constexpr int slice_count = 40;
  float foot_m = 0.0f, top_m = 0.0f;  ///< heights; equal where there is no tree
  std::vector<TreeSlice> slices;      ///< slice_count of them, from below; none where there is no tree

  /// Metres; 0 where there is no tree.
  float slice_height_m() const { return (top_m - foot_m) / float(slice_count); }
};

/// The outline of a volume, by the opacity that the cells have together along a horizontal line, as a
/// photograph shows them, in bins as wide as a cell: a twig is there where at least `min_alpha` of the light
/// is stopped, however it is spread over the cells behind each other. The last bin of each row counts in
/// proportion to its opacity over that of the bin before: where the tree ends is known to a part of a cell.
TreeOutline outline_of(const TreeVolume& volume, float min_alpha);

/// The outline of points.
TreeOutline outline_of(std::span<const glm::vec3> points);

}  // namespace parvis::trees
