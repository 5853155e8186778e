// The scene's sun and sky within a captured tree: what each cell of each level of detail sees of them through
// the crown's own opacity, and what turns its textures, which hold the light of the photographs, into albedo.
//
// A billboard's radiance is texture * (sun * share of the sun + sky * share of the sky) / light of the
// photographs. Under the light of the photographs that is the texture itself, whatever the shares: what the
// opacities say wrongly does no harm until the sun moves.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <utility>
#include <vector>

#include "capture/trees/billboard_tree.h"

namespace parvis::trees {

struct TreeLevels;

/// A number per cell of each level, the finest level first.
using CellShares = std::vector<std::vector<float>>;

/// The light that does not change with the scene's sun.
struct CrownLight {
  CellShares sky;            ///< share of the sky, 0..1
  CellShares albedo_factor;  ///< textures times this are albedo, linear light
  /// Parents in each level but the last: the cell of the next level that a cell is part of.
  std::vector<std::vector<std::uint32_t>> parents;
};

/// The crown of a tree with all its levels.
CrownLight crown_light(const std::vector<BillboardTree>& levels);

/// The share of the sun that reaches each cell from a direction (unit, in the tree's frame), 0..1.
CellShares sun_shares(const TreeLevels& tree, glm::vec3 to_sun);

/// Those of many trees, kept by direction: trees of one kind that are turned alike share them, and the sun
/// has to move by some degrees before they are computed again.
class SunInCrowns {
 public:
  /// Good until the next call.
  const CellShares& shares(const TreeLevels& tree, glm::vec3 to_sun);

 private:
  using Key = std::pair<const TreeLevels*, std::pair<int, int>>;  // azimuth and height in steps
  std::map<Key, CellShares> kept_;
};

/// How far a point of the tree's frame lies within `box` against a direction: beyond that distance nothing of
/// the tree is in the way. In lengths of the direction.
float way_out(const Bounds& box, glm::vec3 point, glm::vec3 direction);

}  // namespace parvis::trees
