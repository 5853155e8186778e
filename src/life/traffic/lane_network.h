// The road graph prepared for driving: lanes without dead ends, safe speeds along them, and lanes that
// exclude each other.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "life/traffic/vehicle_shape.h"
#include "scene/data/path.h"
#include "scene/data/road_graph.h"

namespace parvis::traffic {

/// The circular part of the city in which vehicles drive; metres, in plan.
struct Area {
  glm::vec2 centre{0.0f};
  float radius_m = std::numeric_limits<float>::max();

  float outside_m(glm::vec2 point) const { return std::max(glm::distance(point, centre) - radius_m, 0.0f); }
};

/// A lane with what a driver needs to know.
struct DrivingLane {
  scene::MeasuredPath path;
  std::vector<int> next;   ///< following lanes that are usable
  bool is_usable = false;  ///< does not lead into a dead end
  /// Crosses, leaves or joins another lane: a vehicle must be granted it before it enters (RightOfWay).
  bool is_shared = false;
  std::vector<int> conflicts;  ///< lanes on which vehicles would overlap with vehicles on this one
  /// Distance of its end from the area, metres; in a crossing, that of the street that it leads to.
  float outside_m = 0.0f;
  /// Safe speed (m/s) at every metre from the start: speed limit, curvature, and braking distance ahead of
  /// curves.
  std::vector<float> safe_speeds;

  /// Safe speed in m/s, interpolated; beyond the ends that of the end.
  float safe_speed_at(float distance_m) const;
};

/// Comfortable lateral acceleration, m/s2: limits the speed in curves.
inline constexpr float lateral_acceleration = 2.2f;

/// The lanes of `roads`, long streets cut before their crossings. `shapes` are the vehicles that will drive:
/// two lanes conflict if the largest of them would overlap.
std::vector<DrivingLane> driving_lanes(const scene::RoadGraph& roads, const std::vector<VehicleShape>& shapes,
                                       float comfortable_braking, const Area& area);

}  // namespace parvis::traffic
