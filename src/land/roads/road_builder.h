// From roads (centre lines, as scripts, generators and city models give them) to lanes: right-hand traffic,
// lanes cut back where roads cross or join, and smooth turning lanes through every crossing.
#pragma once

#include <span>

#include "base/result.h"
#include "scene/data/road.h"
#include "scene/data/road_graph.h"

namespace parvis::scene {

/// The lanes of `roads`. Roads that cross or touch in plan (seen from above, within half a lane; but not
/// where one passes more than 3 m above the other), and ends that lie within half a road's width of one
/// another, meet in a crossing with turning lanes: straight on, right, left. A road's end that meets none
/// turns round. A path whose first and last points coincide is a ring. Consecutive equal points are dropped.
/// No roads give an empty graph. Errors, one for each bad road at its `where`: fewer than two different
/// points, numbers that are not finite, no lanes or more than 8, a lane width or a speed limit that is not
/// positive; and of roads that lie along others or crowd one crossing `max_complaints` at most, the first of
/// two that lie along each other being right.
Result<RoadGraph> build_road_graph(std::span<const Road> roads, std::size_t max_complaints = 20);

}  // namespace parvis::scene
