// Where vehicles drive: the part of the road graph that the scene's traffic uses.
#pragma once

#include <vector>

#include "reflections/reference_maps/height_pyramid.h"
#include "scene/data/scene.h"

namespace parvis::reference_maps {

/// Points `apart_m` from each other along the lanes that the scene's traffic uses, on the ground. Where there
/// are no lanes: middles of squares of the ground that nothing stands on, and at least one.
std::vector<glm::vec3> driving_places(const scene::Scene& scene, const HeightPyramid& heights, float apart_m);

}  // namespace parvis::reference_maps
