// How much of the sky the leaves of a crown leave open to a place in it.
#pragma once

#include <span>
#include <vector>

#include "base/bounds.h"

namespace parvis::scene {

/// A leaf, or some leaves that hang together.
struct LeafArea {
  glm::vec3 place;
  float area_m2;  ///< of one side
};

/// Leaf area density on a coarse grid; light passes it as it passes leaves of all directions (Beer and
/// Lambert, an extinction of half the leaf area per volume: Ross 1981).
class CrownOpenness {
 public:
  explicit CrownOpenness(std::span<const LeafArea> leaves);
  /// Share of the sky, weighted by its height, that is seen from a place; at least 0.08, for what leaves
  /// scatter reaches everywhere.
  float at(glm::vec3 place) const;
  /// Share of what lies at a place that is seen past the leaves from outside, from where most of it is.
  float max_seen(glm::vec3 place) const;

 private:
  /// Optical depth of the leaves between a place and the outside in a direction; no more than `enough`.
  float depth(glm::vec3 place, glm::vec3 direction, float enough) const;
  std::size_t index(glm::ivec3 cell) const;

  Bounds box_;
  glm::ivec3 cells_{0};
  float cell_m_ = 1.0f;
  std::vector<float> depth_of_cell_;  ///< optical depth of its leaves across one side
};

}  // namespace parvis::scene
