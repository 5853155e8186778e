// Streets too narrow for two cars become one-way, where one can still get everywhere.
#pragma once

#include <vector>

#include "land/roads/road_builder.h"

namespace parvis::scene {

/// Makes roads narrower than two lanes of `narrowest_lane_m` one-way, in either direction, as long as their
/// start can be reached from their end by other roads; roads meet where ends are equal. The others stay as
/// they are.
void make_narrow_streets_one_way(std::vector<Road>& roads, float narrowest_lane_m);

}  // namespace parvis::scene
