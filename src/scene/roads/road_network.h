// Roads as a network: streets that run from crossing to crossing. The first half of the road builder.
#pragma once

#include <span>
#include <vector>

#include "base/result.h"
#include "scene/data/path.h"
#include "scene/roads/road_builder.h"

namespace parvis::scene {

/// A piece of a road between two crossings (or ends), along the road's own direction.
struct Street {
  MeasuredPath path;
  std::size_t road = 0;  ///< index into the roads given
  int start_node = 0;
  int end_node = 0;
};

struct RoadNetwork {
  std::vector<Street> streets;
  int node_count = 0;  ///< crossings, joints and dead ends
};

/// Half of a road's width over all its lanes.
float half_width_m(const Road& road);

/// Finds where roads meet and cuts them there; places closer together than the roads are wide become one
/// node. Errors as build_road_graph says.
Result<RoadNetwork> connect_roads(std::span<const Road> roads);

}  // namespace parvis::scene
