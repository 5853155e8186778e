// Placement of reference maps. The paper (section 3) leaves it open and asks for it in section 8: "REMs
// should be automatically positioned in the environment".
#pragma once

#include <cstdint>
#include <vector>

#include "reflections/reference_maps/height_pyramid.h"
#include "reflections/reference_maps/mirrored_points.h"
#include "scene/data/scene.h"

namespace parvis::reference_maps {

/// When placement stops.
struct PlacementGoal {
  int max_maps = 54;
  float share_shown = 0.99f;  ///< of the points that vehicles mirror; above 1: all maps that add anything
  /// Thresholds for `shows`. With several, a point counts once for each; `share_shown` refers to the last.
  std::vector<float> sharpness{any_sharpness};
  std::uint64_t seed = 1;
};

/// Chosen places and how much they show.
struct Placement {
  std::vector<glm::vec3> places;  ///< metres, in the world
  float share_shown = 0.0f;       ///< measured on points that the choice did not use
};

/// Chooses places over the streets that show what vehicles will mirror, at least `min_apart_m` apart. Takes a
/// few seconds in a city; the same goal gives the same places.
Placement place_by_coverage(const scene::Scene& scene, const HeightPyramid& heights,
                            const PlacementGoal& goal);

/// A number of places, `maximum` or fewer, chosen by how sharply they show the scene: the default.
Placement place_for_pictures(const scene::Scene& scene, const HeightPyramid& heights, int maximum);

/// Minimum distance between maps, metres: closer, a second map adds nothing.
inline constexpr float min_apart_m = 8.0f;

/// Places, `maximum` or fewer, spread evenly over the streets that the scene's traffic uses (farthest point
/// sampling), at least `min_apart_m` apart; where there are no streets, over the open ground. Metres, in the
/// world. The baseline for placement by coverage.
std::vector<glm::vec3> spread_places(const scene::Scene& scene, const HeightPyramid& heights, int maximum);

/// The same over all roads of the scene, whether driven on or not: figure 8 of the paper has 54 on 8 km.
std::vector<glm::vec3> spread_over_roads(const scene::Scene& scene, const HeightPyramid& heights,
                                         int maximum);

}  // namespace parvis::reference_maps
