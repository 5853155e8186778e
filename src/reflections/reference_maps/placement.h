// Where reference maps are taken. The paper (section 3) leaves it open and asks for it in section 8: "REMs
// should be automatically positioned in the environment".
#pragma once

#include <cstdint>
#include <vector>

#include "reflections/reference_maps/height_pyramid.h"
#include "reflections/reference_maps/mirrored_points.h"
#include "scene/data/scene.h"

namespace parvis::reference_maps {

/// When there are maps enough.
struct PlacementGoal {
  int most = 54;              ///< maps
  float share_shown = 0.99f;  ///< of what vehicles mirror; above 1: all the maps that add anything
  /// Of `shows`. Where there are several a point counts once for each of them; the share is of the last.
  std::vector<float> sharpness{any_sharpness};
  std::uint64_t seed = 1;
};

struct Placement {
  std::vector<glm::vec3> places;  ///< metres, in the world
  float share_shown = 0.0f;       ///< of points that the choice did not see
};

/// Places over the streets that show what vehicles will mirror. None is nearer than `min_apart_m` to
/// another. Takes some seconds in a city; the same goal gives the same places.
Placement place_by_coverage(const scene::Scene& scene, const HeightPyramid& heights,
                            const PlacementGoal& goal);

/// Up to `most` maps that show all they can, sharply rather than only just: the default.
Placement place_for_pictures(const scene::Scene& scene, const HeightPyramid& heights, int most);

/// Distance below which a second map adds nothing.
inline constexpr float min_apart_m = 8.0f;

/// At most `most` places over the streets that the scene's traffic uses, as even a spread as can be: each
/// next one where a street lies farthest from all before it, none nearer than `min_apart_m` to another.
/// Where there are no streets: a spread over the open ground. Metres, in the world. What placement by
/// coverage is compared with.
std::vector<glm::vec3> spread_places(const scene::Scene& scene, const HeightPyramid& heights, int most);

/// The same over all of the scene's roads, driven on or not: figure 8 of the paper has 54 on 8 km.
std::vector<glm::vec3> spread_over_roads(const scene::Scene& scene, const HeightPyramid& heights, int most);

}  // namespace parvis::reference_maps
