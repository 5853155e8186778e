// The two reference maps that a place lies between.
#pragma once

#include <cstdint>
#include <vector>

#include "reflections/reference_maps/map_choice.h"

namespace parvis::reference_maps {

/// Indices into the places of the maps; the same one twice where there is only one.
struct MapPair {
  int first = 0, second = 0;

  std::uint32_t packed() const { return std::uint32_t(first) | std::uint32_t(second) << 16; }
  bool operator==(const MapPair&) const = default;
};

/// The best map for a place, and of those next to it the nearest that lies on the place's other side: along a
/// street the two between which it stands. Where none does, the second best.
MapPair pair_about(glm::vec3 place, const std::vector<glm::vec3>& maps, const MapChoice& choice);

}  // namespace parvis::reference_maps
