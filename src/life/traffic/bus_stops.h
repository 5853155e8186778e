// Bus stops beside lanes: buses halt at them, and people wait, board and alight (life/crowd, passengers).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "land/roads/transit_stops.h"
#include "life/traffic/lane_network.h"
#include "scene/data/scene.h"

namespace parvis::traffic {

/// A stop that the node `busStop` asks for.
struct BusStopDemand {
  static constexpr std::string_view name = "traffic.bus_stops";
  static constexpr scene::DataRole role =
      scene::DataRole::settings;  // pictures show poles, which are objects
  glm::vec3 position{0.0f};       ///< of the pole, beside the lane, where the front of a bus halts
  float dwell_s = 12.0f;          ///< how long doors are open, at least
  bool is_visible = true;
  bool is_of_map = false;   ///< a map has a stop there: without a lane beside it there is none
  FileLocation where = {};  ///< of its node

  /// Adds all members but `where`; see SceneData.
  void hash(ContentHash& hash) const {
    hash.add(position), hash.add(dwell_s), hash.add(is_visible), hash.add(is_of_map);
  }
};

/// A stop on a driving lane.
struct BusStop {
  int lane = 0;
  float front_m = 0.0f;  ///< where the front bumper of a bus halts, along the lane
  float dwell_s = 12.0f;
  glm::vec3 kerb{0.0f};      ///< the pole's foot
  glm::vec2 along{1, 0};     ///< unit vector of travel
  glm::vec2 kerbward{0, 1};  ///< unit vector from the lane to the pole
};

/// True for vehicles that halt at bus stops: their models say so by their names, or are as long as buses.
bool is_bus(const VehicleShape& shape);

/// The stop beside the nearest lane that leads past the position at its left (traffic keeps to the right) and
/// has room for a bus of `length_m` before it. Nothing where none does within 8 m.
std::optional<BusStop> bus_stop_at(std::span<const DrivingLane> lanes, const BusStopDemand& demand,
                                   float length_m);

/// The direction from the lane of a stop at this position to it, in plan; nothing where no lane leads past
/// it.
std::optional<glm::vec2> kerbward_of(const scene::RoadGraph& roads, glm::vec3 position);

/// The stop as people see it: doors where those of a bus of this shape are that halts there.
scene::TransitStop transit_stop(const BusStop& stop, const VehicleShape& bus);

/// The pole with its sign, in the world's frame; `kerbward` points away from the lane.
std::shared_ptr<const scene::Model> bus_stop_pole(glm::vec3 foot, glm::vec2 kerbward);

/// A bus between two stops, or at one.
struct BusTrip {
  bool is_bus = false;  ///< others halt nowhere
  int stop = -1;        ///< at which it halts; -1: none
  int served = -1;      ///< the last one, while it has not left it
  float halts_s = 0.0f;
};

inline constexpr float bus_doors_s = 1.2f;         ///< that doors take to open and to close
inline constexpr float bus_waits_s = 25.0f;        ///< for people on the way to the doors, at most
inline constexpr float bus_halts_within_m = 1.5f;  ///< of the place of its stop

}  // namespace parvis::traffic
