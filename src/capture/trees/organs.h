// Trunk, branches and leaves of a captured tree, distinguished by colour and by place; the trunk as geometry.
//
// Past the thesis, which keeps no meaning in its cells (003_d5b01da2d2f805f6, chapter 7, names a hybrid of
// geometry and volume as future work). Leaves absorb red light more than green light, bark does not: the
// ratio of the two separates them whatever the light's brightness. The trunk is followed upward from the foot
// through what is no leaf.
#pragma once

#include <span>
#include <vector>

#include "capture/trees/tree_volume.h"
#include "capture/trees/trunk_shape.h"

namespace parvis::trees {

/// The organ that fills most of a cell.
enum class Organ : std::uint8_t { trunk, branch, leaf };

/// The organs of a tree.
struct Organs {
  std::vector<Organ> of_cell;  ///< per cell of the volume
  Trunk trunk;
  float leaf_threshold = 0.0f;  ///< logarithm of green over red, linear light, above which a cell is a leaf

  /// The share of the tree's extinction that is in cells of this organ, 0..1.
  float share(const TreeVolume& volume, Organ organ) const;
};

/// Organs of a volume. A tree without leaves has none; a crown that reaches the ground has no trunk.
Organs organs_of(const TreeVolume& volume);

/// The cells that are of no such organ.
TreeVolume without(const TreeVolume& volume, const Organs& organs, Organ organ);

/// Makes the trunk transparent in the photographs: what lies within its outline, half a cell of the volume
/// and a pixel round it, and is no leaf. Textures of such photographs leave it to the geometry; else
/// billboards beside the trunk, through which photographs show it, would hide it behind a picture of itself.
void erase_trunk(std::vector<TreeView>& views, const TreeVolume& volume, const Organs& organs);

/// The trunk with the photographs as its bark (bark_texture.h). Errors: there are fewer than two rings.
Result<TrunkShape> trunk_shape(const Organs& organs, std::span<const TreeView> views);

}  // namespace parvis::trees
