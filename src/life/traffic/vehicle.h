// The state of one vehicle: its route over lanes, its motion along them, and its pose.
#pragma once

#include <span>
#include <vector>

#include "base/random.h"
#include "life/traffic/lane_network.h"
#include "life/traffic/occupancy.h"
#include "life/traffic/right_of_way.h"

namespace parvis::traffic {

inline constexpr std::size_t longest_route = 48;  // lanes that a vehicle remembers and plans
inline constexpr float planned_ahead_m = 80.0f;

/// A vehicle in motion; metres, seconds, m/s.
struct Vehicle {
  const VehicleShape* shape = nullptr;
  std::vector<int> route;      ///< lanes: those under the body, the front bumper's lane, then those ahead
  std::size_t current = 0;     ///< index into `route` of the front bumper's lane
  std::size_t held_until = 0;  ///< shared lanes of `route` before this index are held (see RightOfWay)
  int promised_lane = -1;      ///< lane on which room is reserved for it; -1: none
  float front_m = 0.0f;        ///< along the current lane
  float speed = 0.0f;
  float acceleration = 0.0f;
  float waited_s = 0.0f;  ///< since it first requested the lanes ahead
  float last_move_m = 0.0f;
  double travelled_m = 0.0;
  Random random{0};

  /// Index of the lane of the front bumper.
  int lane() const { return route[current]; }
  /// Length over the bumpers, metres.
  float length_m() const { return shape->length_m(); }
  /// Length that it occupies in a queue, metres.
  float room_m() const { return length_m() + 2.5f; }
  /// True if it can stop on the lane completely, clear of shared lanes.
  bool can_rest_on(const DrivingLane& lane) const {
    return !lane.is_shared && lane.path.length() > room_m() + 2.5f;
  }

  /// Extends the route, choosing at random among the turns that stay in the area, until it is long enough and
  /// ends where the vehicle can stop.
  void plan(std::span<const DrivingLane> lanes);
  /// Discards the route from `index` on and plans it again.
  void plan_anew(std::size_t index, std::span<const DrivingLane> lanes);
  /// Moves the front bumper forward and releases the shared lanes that the tail has left.
  void advance(float distance_m, std::span<const DrivingLane> lanes, RightOfWay& rights);
  /// Adds the sections of all lanes that the body covers; `index` identifies the vehicle.
  void note_presence(int index, std::span<const DrivingLane> lanes, Occupancy& occupancy) const;

  /// The point of the route `distance_m` behind the front bumper (negative: ahead), in the world.
  glm::vec3 point_behind(float distance_m, std::span<const DrivingLane> lanes) const;
  /// Position of the front axle if the vehicle were `back_m` behind its present place, in the world.
  glm::vec3 front_axle(float back_m, std::span<const DrivingLane> lanes) const;
  /// Position of the rear axle in the same way.
  glm::vec3 rear_axle(float back_m, std::span<const DrivingLane> lanes) const;
  /// Outline on the ground if the vehicle were `back_m` behind its present place.
  Footprint footprint(float back_m, std::span<const DrivingLane> lanes) const;
  /// Angle between the body and the route at the front axle in radians, positive to the left.
  float steering(float back_m, std::span<const DrivingLane> lanes) const;
};

}  // namespace parvis::traffic
