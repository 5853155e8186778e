// From roads (centre lines, as scripts, generators and city models give them) to lanes: right-hand traffic,
// lanes cut back where roads cross or join, and smooth turning lanes through every crossing.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/road_graph.h"

namespace parvis::scene {

/// A road as its author sees it: one centre line for both directions of travel.
struct Road {
  std::vector<glm::vec3> path;  ///< centre line on the ground, metres; lanes take their height from it
  int lanes_each_way = 1;
  bool is_one_way =
      false;  ///< all lanes run from the path's first point to its last, side by side about the path
  float lane_width_m = 3.0f;
  float speed_limit = 13.9f;  ///< m/s
  FileLocation where;         ///< of the script's node, for errors
  std::string name;           ///< for errors; may be empty
};

/// The lanes of `roads`. Roads that cross or touch in plan (seen from above, within half a lane; but not
/// where one passes more than 3 m above the other), and ends that lie within half a road's width of one
/// another, meet in a crossing with turning lanes: straight on, right, left. A road's end that meets none
/// turns round. A path whose first and last points coincide is a ring. Consecutive equal points are dropped.
/// No roads give an empty graph. Errors, one for each bad road at its `where`: fewer than two different
/// points, numbers that are not finite, no lanes or more than 8, a lane width or a speed limit that is not
/// positive, a road that lies along another.
Result<RoadGraph> build_road_graph(std::span<const Road> roads);

}  // namespace parvis::scene
