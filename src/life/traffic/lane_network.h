// The road graph made ready for driving: lanes that lead somewhere, how fast each place may be taken, and
// which lanes cannot be used at the same time.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "life/traffic/vehicle_shape.h"
#include "scene/data/path.h"
#include "scene/data/road_graph.h"

namespace parvis::traffic {

/// The part of the town that vehicles keep to.
struct Area {
  glm::vec2 centre{0.0f};
  float radius_m = std::numeric_limits<float>::max();

  float outside_m(glm::vec2 point) const { return std::max(glm::distance(point, centre) - radius_m, 0.0f); }
};

struct DrivingLane {
  scene::MeasuredPath path;
  std::vector<int> next;   ///< only lanes that lead on
  bool is_usable = false;  ///< a vehicle that enters it can drive on for ever
  bool is_shared =
      false;  ///< crosses, leaves or joins another lane's way: to be asked for before it is entered
  std::vector<int> conflicts;      ///< lanes whose way overlaps with this one's
  float outside_m = 0.0f;          ///< of the area: its end, or in a crossing, that of the street it leads to
  std::vector<float> safe_speeds;  ///< m/s at every metre from the start: limit, bends, and braking for them

  float safe_speed_at(float distance_m) const;
};

/// Lateral acceleration that passengers find comfortable, m/s2: sets the speed in bends.
inline constexpr float lateral_acceleration = 2.2f;

/// The lanes of `roads`, long streets cut before their crossings. `shapes` are the vehicles to come: two
/// lanes conflict where the largest of them would touch one another.
std::vector<DrivingLane> driving_lanes(const scene::RoadGraph& roads, const std::vector<VehicleShape>& shapes,
                                       float comfortable_braking, const Area& area);

}  // namespace parvis::traffic
