// One vehicle on its way: the lanes under it and before it, and how it moves along them.
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

struct Vehicle {
  const VehicleShape* shape = nullptr;
  std::vector<int> route;      ///< under the body, then the front bumper's lane, then those to come
  std::size_t current = 0;     ///< index into `route` of the front bumper's lane
  std::size_t held_until = 0;  ///< shared lanes of `route` before this index are held (see RightOfWay)
  int promised_lane = -1;      ///< where room is kept for it
  float front_m = 0.0f;        ///< along the current lane
  float speed = 0.0f;
  float acceleration = 0.0f;
  float waited_s = 0.0f;  ///< since it first asked for the lanes before it
  float last_move_m = 0.0f;
  double travelled_m = 0.0;
  Random random{0};

  int lane() const { return route[current]; }
  float length_m() const { return shape->length_m(); }
  /// What it takes in a queue.
  float room_m() const { return length_m() + 2.5f; }
  /// Whether it can stand there whole, clear of what is shared.
  bool can_rest_on(const DrivingLane& lane) const {
    return !lane.is_shared && lane.path.length() > room_m() + 2.5f;
  }

  /// Extends the route, turning at random among the ways that keep to the area, until it reaches far enough
  /// and ends where the vehicle can rest.
  void plan(std::span<const DrivingLane> lanes);
  /// Forgets the route from `index` on and plans it anew.
  void plan_anew(std::size_t index, std::span<const DrivingLane> lanes);
  /// Moves the front bumper; gives back the shared lanes that the tail has left.
  void advance(float distance_m, std::span<const DrivingLane> lanes, RightOfWay& rights);
  void note_presence(int index, std::span<const DrivingLane> lanes, Occupancy& occupancy) const;

  /// The point of the route `distance_m` behind the front bumper (negative: before it).
  glm::vec3 point_behind(float distance_m, std::span<const DrivingLane> lanes) const;
  /// Where the axles stand if the vehicle were `back_m` behind its place.
  glm::vec3 front_axle(float back_m, std::span<const DrivingLane> lanes) const;
  glm::vec3 rear_axle(float back_m, std::span<const DrivingLane> lanes) const;
  Footprint footprint(float back_m, std::span<const DrivingLane> lanes) const;
  /// Angle from the body to the way at the front axle, positive to the left.
  float steering(float back_m, std::span<const DrivingLane> lanes) const;
};

}  // namespace parvis::traffic
