// Simulation of the vehicles on a road graph, in fixed time steps.
#pragma once

#include <optional>
#include <vector>

#include "land/roads/street_crossings.h"
#include "life/traffic/bus_stops.h"
#include "life/traffic/car_following.h"
#include "life/traffic/signals.h"
#include "life/traffic/vehicle.h"
#include "scene/action/event_queue.h"

namespace parvis::traffic {

/// Time step of the simulation, seconds.
inline constexpr float step_s = float(action::step_s);

/// All vehicles on one road graph. The same road graph, shapes, area and seed give the same motion.
class Simulation {
 public:
  Simulation(const scene::RoadGraph& roads, std::vector<VehicleShape> shapes, const Area& area);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Places up to `wanted` vehicles with motors, then up to `bicycles`, at rest on the streets of the area,
  /// with room between them, and returns how many fitted. Asserts that there are shapes of what is wanted.
  std::size_t spread_vehicles(std::size_t wanted, std::uint64_t seed, std::size_t bicycles = 0);
  /// Advances the simulation by `step_s`. Allocates no memory.
  void step();
  /// Sets traffic lights, which vehicles obey from now on.
  void set_signals(Signals signals) { signals_ = std::move(signals); }
  const Signals& signals() const { return signals_; }  ///< those set
  /// Gives way to people on the crossings of `streets` and to trams from now on, and writes there which
  /// crossings are taken by vehicles, what lights people see, and where vehicles are. It must outlive the
  /// simulation.
  void share(scene::StreetTraffic& streets);
  /// Sets the stops at which buses halt, and how people see them: the first ones of `shown`, in the same
  /// order. After vehicles are spread, before the first step.
  void set_bus_stops(std::vector<BusStop> stops, std::shared_ptr<std::vector<scene::TransitStop>> shown);
  /// The trips of the vehicles between these stops, in the order of vehicles().
  const std::vector<BusTrip>& bus_trips() const { return bus_trips_; }
  /// False: vehicles drive as if all lights were green.
  bool heeds_signals = true;
  /// False: they drive and stand on crossings as if nobody walked there.
  bool heeds_crossings = true;
  /// False: they drive onto crossings and tracks without room for them behind.
  bool keeps_crossings_free = true;

  /// Lanes of the road graph after streets are cut.
  const std::vector<DrivingLane>& lanes() const { return lanes_; }
  /// Vehicles in the order in which they were placed.
  const std::vector<Vehicle>& vehicles() const { return vehicles_; }

 private:
  struct Obstacle {
    float gap_m;
    float speed;
  };

  void note_presences();
  void settle_rights();
  bool wants_right(std::size_t index) const;
  void ask_for_right(Vehicle& vehicle, std::size_t index);
  bool has_room(const Vehicle& vehicle, std::size_t index, int lane) const;
  Obstacle obstacle_ahead(std::size_t index) const;
  struct Stretch {
    float from_m, to_m;  ///< from the front bumper
  };
  struct Stop {
    std::size_t turn = 0;  ///< index into the route
    float line_m = 0.0f;   ///< from the front bumper
    DriveLight light = DriveLight::green;
  };
  std::optional<Stop> light_ahead(const Vehicle& vehicle) const;
  bool must_stop(const Vehicle& vehicle, const Stop& stop) const;
  void heed_signals(std::size_t index, Obstacle& nearest);
  std::optional<Stretch> stretch_on(std::size_t index, const scene::StreetCrossing& crossing,
                                    float seen_m) const;
  void heed_crossings(std::size_t index, Obstacle& nearest);
  void heed_rails(std::size_t index, Obstacle& nearest);
  void heed_bus_stops(std::size_t index, Obstacle& nearest);
  void write_lights();
  void write_vehicles();
  float wanted_speed(const Vehicle& vehicle) const;
  bool would_touch(std::size_t index, float distance_m) const;
  void move(std::size_t index);

  Driver driver_;
  Area area_;
  std::vector<VehicleShape> shapes_;
  std::vector<DrivingLane> lanes_;
  RightOfWay rights_;
  Occupancy occupancy_;
  std::vector<Vehicle> vehicles_;
  std::vector<float> promised_room_m_;  ///< of each lane, to vehicles that are on their way to it
  std::vector<std::size_t> asking_;     ///< vehicles that ask for a right in this step
  std::vector<int> wanted_;             ///< lanes that one vehicle asks for
  std::vector<Footprint> footprints_;   ///< of the vehicles, as far as they have moved in this step
  std::vector<std::size_t> from_west_;  ///< vehicles in the order of x, at the step's beginning
  float longest_reach_m_ = 0.0f;        ///< between the middles of two vehicles that touch
  Signals signals_;
  std::vector<BusStop> bus_stops_;
  std::shared_ptr<std::vector<scene::TransitStop>> shown_stops_;  ///< as people see them
  std::vector<BusTrip> bus_trips_;                                ///< of each vehicle
  scene::StreetTraffic* streets_ = nullptr;
};

}  // namespace parvis::traffic
