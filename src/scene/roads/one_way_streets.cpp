#include "scene/roads/one_way_streets.h"

#include <algorithm>

namespace parvis::scene {

namespace {

bool is_way_from(const Road& road, glm::vec3 place) {
  return road.path.front() == place || (!road.is_one_way && road.path.back() == place);
}

/// Whether one gets from the end of `street` to its start without it.
bool has_way_round(const std::vector<Road>& roads, const Road& street) {
  std::vector<glm::vec3> reached{street.path.back()};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const Road& road : roads) {
      if (&road == &street || !is_way_from(road, reached[i])) continue;
      const glm::vec3 there = road.path.front() == reached[i] ? road.path.back() : road.path.front();
      if (std::ranges::find(reached, there) == reached.end()) reached.push_back(there);
    }
  return std::ranges::find(reached, street.path.front()) != reached.end();
}

}  // namespace

void make_narrow_streets_one_way(std::vector<Road>& roads, float narrowest_lane_m) {
  for (Road& road : roads) {
    if (road.is_one_way || road.lanes_each_way > 1 || road.lane_width_m >= narrowest_lane_m) continue;
    road.is_one_way = has_way_round(roads, road);
    if (!road.is_one_way) {
      std::ranges::reverse(road.path);
      road.is_one_way = has_way_round(roads, road);
    }
    if (road.is_one_way) road.lane_width_m *= 2.0f;
    road.lane_width_m = std::max(road.lane_width_m, narrowest_lane_m);
  }
}

}  // namespace parvis::scene
