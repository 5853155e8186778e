// Ground for places that bring none: between the buildings, and from there to the horizon.
#pragma once

#include <string>

#include "land/heights/place_heights.h"
#include "scene/data/model.h"

namespace parvis::dressing {

/// The look of a terrain; each surface is one of ground_covers().
struct TerrainLook {
  std::string surface = "paving";  ///< near buildings
  std::string beyond = "lawn";     ///< elsewhere
  float reach_m = 6000.0f;         ///< from the middle of the place, at least; more for wide or hilly ones
};

/// Ground over the plan of the heights, left out where the place has its own: paved near what is built.
scene::Model near_terrain(const scene::PlaceHeights& place, const TerrainLook& look);

/// The land from the edge of that plan to `reach_m`; it levels out on the way.
scene::Model land_around(const scene::PlaceHeights& place, const TerrainLook& look);

}  // namespace parvis::dressing
