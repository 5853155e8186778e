// The ground below a map's streets: what stands beside them stands on the ground that is cut and filled.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "formats/readers/ground_on_map.h"
#include "scene/data/road.h"

namespace parvis::scene {

/// The ground as it is once streets are paved (land/roads/earthworks.h), with the turns through their
/// crossings. `roads` lie about `origin`, at heights on the map; where they are higher than `ground` they are
/// bridges and ramps, and the ground is only cut. Empty where `ground` is.
GroundOnMap ground_shaped_for(const std::vector<Road>& roads, const GroundOnMap& ground,
                              const glm::dvec3& origin);

}  // namespace parvis::scene
