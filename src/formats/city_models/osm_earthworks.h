// The ground below a map's streets: what stands beside them stands on the ground that is cut and filled.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "formats/readers/ground_on_map.h"
#include "land/roads/earthworks.h"
#include "scene/data/model.h"
#include "scene/data/road.h"

namespace parvis::scene {

/// The ground as it is once streets are paved (land/roads/earthworks.h), with the turns through their
/// crossings. `roads` lie about `origin`, at heights on the map; where they are higher than `ground` they are
/// bridges and ramps, and the ground is only cut. Empty where `ground` is.
GroundOnMap ground_shaped_for(const std::vector<Road>& roads, const GroundOnMap& ground,
                              const glm::dvec3& origin);

/// The works that carry ramps to bridges on level ground at z = 0: banks about them, and level beds of the
/// ways near them. `roads` lie about the model's origin; those of `is_bridge` have decks. Null where no ramp
/// is.
std::shared_ptr<const Earthworks> works_for_ramps(const std::vector<Road>& roads,
                                                  const std::function<bool(const Road&)>& is_bridge);

/// Raises the level ground of a model (land use, plants, water, paths, each at its own height) as the works
/// have it. Its triangles are divided where the works bend them.
void raise_ground(Model& model, const Earthworks& works);

}  // namespace parvis::scene
