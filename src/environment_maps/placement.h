// Where reference maps are taken.
#pragma once

#include <vector>

#include "environment_maps/height_pyramid.h"
#include "scene/scene.h"

namespace parvis::environment_maps {

/// Distance below which a second map adds nothing.
inline constexpr float least_apart_m = 8.0f;

/// At most `most` places over the streets that the scene's traffic uses, as even a spread as can be: each
/// next one where a street lies farthest from all before it, none nearer than `least_apart_m` to another.
/// Where there are no streets: a spread over the open ground. Metres, in the world.
std::vector<glm::vec3> spread_places(const scene::Scene& scene, const HeightPyramid& heights, int most);

}  // namespace parvis::environment_maps
