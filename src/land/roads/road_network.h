// Roads as a network: streets between crossings. The first half of the road builder.
#pragma once

#include <span>
#include <vector>

#include "base/result.h"
#include "land/roads/road_builder.h"
#include "scene/data/path.h"

namespace parvis::scene {

/// A piece of a road between two crossings (or ends), along the road's own direction.
struct Street {
  MeasuredPath path;
  std::size_t road = 0;  ///< index into the roads given
  int start_node = 0;
  int end_node = 0;
};

/// Streets and the nodes that they connect; nodes are numbered from 0.
struct RoadNetwork {
  std::vector<Street> streets;
  int node_count = 0;  ///< crossings, joints and dead ends
};

/// Half of a road's width over all its lanes.
float half_width_m(const Road& road);

/// Intersects the roads and cuts them at crossings; crossings closer together than the roads are wide are
/// merged into one node. Errors: see build_road_graph.
Result<RoadNetwork> connect_roads(std::span<const Road> roads, std::size_t max_complaints);

}  // namespace parvis::scene
