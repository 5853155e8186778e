// Which reference maps a place on the ground looks into.
#pragma once

#include <cstdint>
#include <vector>

#include "reflections/reference_maps/height_pyramid.h"

namespace parvis::reference_maps {

/// The maps for each part of the ground: of the nearest ones, those that see it first.
class MapChoice {
 public:
  static constexpr int maps_per_cell = 4;
  MapChoice(const std::vector<glm::vec3>& places, const HeightPyramid& heights);

  glm::vec2 origin() const { return origin_; }  ///< south-west corner, metres
  float cell_m() const { return cell_m_; }
  glm::ivec2 cells() const { return cells_; }
  /// `maps_per_cell` indices into the places a cell, the best first, row 0 in the south; the last one repeats
  /// where there are fewer.
  const std::vector<std::uint16_t>& indices() const { return indices_; }

 private:
  glm::vec2 origin_{0.0f};
  float cell_m_ = 4.0f;
  glm::ivec2 cells_{1};
  std::vector<std::uint16_t> indices_;
};

}  // namespace parvis::reference_maps
