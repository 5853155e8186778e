// What a captured tree shows closer than its photographs: a pattern of leaves, or of twigs, synthesised from
// its own textures (past the thesis, 003_d5b01da2d2f805f6, section 4.8, which comes no closer than the
// cameras). A crown resembles itself: leaves on a twig are spread as twigs on a branch are, so that what the
// photographs show at the scale of their pixels stands in for what is finer (leaf_detail.glsl).
//
// Patches of the photographs, as the tree shows them, are blended at places that a seed says with weights
// that keep their variance, and ranked, so that values are spread evenly (after Heitz and Neyret 2018,
// "High-performance by-example noise using a histogram-preserving blending operator").
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>
#include <vector>

#include "capture/trees/billboard_tree.h"

namespace parvis::trees {

/// A periodic tile.
struct LeafDetail {
  static constexpr int side = 64;  ///< texels

  /// Detail of opacity and of brightness, -127..127 for -1..1; each has the mean 0 and they are uncorrelated,
  /// so that neither opacity nor colour change in the mean. Row by row; empty: the tree has no detail.
  std::vector<glm::i8vec2> texels;
  float photographed_pixel_m = 0.0f;  ///< the width at the tree's middle, in its frame, in the mean

  /// False where the photographs show no pattern.
  bool is_empty() const { return texels.empty(); }
  /// The tile's width on a billboard, in the tree's frame.
  float width_m() const;
  /// Where a cell's billboard has its middle in the tile (0..1): neighbours do not repeat each other.
  static glm::vec2 offset_of(std::size_t cell);
  /// Opacity and brightness at a place in tiles, between texels linear.
  glm::vec2 at(glm::vec2 place) const;
  /// A texture's colour (linear, premultiplied) at a place in tiles, with the detail for a pixel of this
  /// width in the tree's frame; 0: with all of it.
  glm::vec4 added_to(glm::vec4 colour, glm::vec2 place, float pixel_m) const;
};

/// Detail of the finest level of a tree. The same tree and seed have the same detail.
LeafDetail leaf_detail(const BillboardTree& tree, std::uint64_t seed = 1);

}  // namespace parvis::trees
