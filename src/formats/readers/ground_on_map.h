// The ground that a place without heights of its own is put on.
#pragma once

#include <functional>
#include <glm/glm.hpp>

namespace parvis::scene {

/// Metres above the map's zero at a place on the map, everywhere; empty: z = 0.
using GroundOnMap = std::function<double(glm::dvec2 on_map)>;

}  // namespace parvis::scene
