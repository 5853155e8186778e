// How much of the sky a plant's own leaves leave open to a place in it.
#pragma once

#include <vector>

#include "life/vegetation/plant_shape.h"

namespace parvis::vegetation {

/// Leaf area density on a coarse grid; light passes it as it passes leaves of all directions (Beer and
/// Lambert, an extinction of half the leaf area per volume: Ross 1981).
class CrownOpenness {
 public:
  /// From the leaves' places and areas.
  explicit CrownOpenness(const std::vector<Leaf>& leaves, float area_of_unit_leaf);
  /// Share of the sky, weighted by its height, that is seen from a place in the plant's frame; at least 0.08,
  /// for what leaves scatter reaches everywhere.
  float at(glm::vec3 place) const;

 private:
  float extinction_per_m(glm::vec3 place) const;

  Bounds box_;
  glm::ivec3 cells_{0};
  float cell_m_ = 1.0f;
  std::vector<float> density_;  ///< leaf area per volume, 1/m
};

}  // namespace parvis::vegetation
