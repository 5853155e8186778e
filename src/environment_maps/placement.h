// Where reference maps are taken.
#pragma once

#include <vector>

#include "environment_maps/height_pyramid.h"
#include "scene/scene.h"

namespace parvis::environment_maps {

/// At most `most` places over the streets that the scene's traffic uses, as even a spread as can be: each
/// next one where a street lies farthest from all before it, none nearer than `least_apart_m` to another.
/// Where there are no streets: a spread over the open ground. Metres, in the world.
std::vector<glm::vec3> spread_places(const scene::Scene& scene, const HeightPyramid& heights, int most);

/// Distance below which a second map adds nothing.
inline constexpr float least_apart_m = 8.0f;

/// The maps for each part of the ground: of the nearest ones, those that see it first.
class MapChoice {
 public:
  static constexpr int maps_a_cell = 4;
  MapChoice(const std::vector<glm::vec3>& places, const HeightPyramid& heights);

  glm::vec2 origin() const { return origin_; }  ///< south-west corner, metres
  float cell_m() const { return cell_m_; }
  glm::ivec2 cells() const { return cells_; }
  /// `maps_a_cell` indices into the places a cell, the best first, row 0 in the south; the last one repeats
  /// where there are fewer.
  const std::vector<std::uint16_t>& indices() const { return indices_; }

 private:
  glm::vec2 origin_{0.0f};
  float cell_m_ = 4.0f;
  glm::ivec2 cells_{1};
  std::vector<std::uint16_t> indices_;
};

}  // namespace parvis::environment_maps
