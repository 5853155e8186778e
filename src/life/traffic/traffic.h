// Cars, vans and buses on a scene's road graph: they keep their lane and their distance, give way at
// crossings, and slow down in curves. Seeded and with a fixed time step, so that the same scene gives the
// same traffic everywhere.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "life/traffic/demand.h"
#include "life/traffic/simulation.h"
#include "scene/data/scene.h"

namespace parvis::traffic {

/// Name of the object of a vehicle, counted from 1 ("vehicle 1"): cameras follow vehicles by these names.
inline std::string vehicle_name(std::size_t vehicle) { return fmt::format("vehicle {}", vehicle + 1); }

/// The traffic of one scene.
class Traffic {
 public:
  /// Reads the scene's roads, traffic demand and traffic lights. Vehicles are spread over the streets and
  /// have driven for a while. `crossings`: those of the scene.
  explicit Traffic(const scene::Scene& scene, std::span<const scene::StreetCrossing> crossings = {});

  /// Appends one object per vehicle to the scene at its present place. Call it once.
  void add_vehicles(scene::Scene& scene);
  /// Appends the lit lamps of the traffic lights. Call it once, after `add_vehicles`.
  void add_lamps(scene::Scene& scene);
  /// Advances the simulation by `step_s`. Allocates no memory.
  void step() { simulation_->step(); }
  /// Shares the scene's streets with people who walk: Simulation::share.
  void share(scene::StreetTraffic& streets) { simulation_->share(streets); }
  /// Places the objects of `add_vehicles` and shows those of `add_lamps` `ahead_s` (0 to `step_s`) after the
  /// last step but one: interpolated between the last two steps.
  void place(scene::Scene& scene, double ahead_s) const;

  /// Bus stops at which buses halt, as people see them; empty where there are none.
  const std::shared_ptr<std::vector<scene::TransitStop>>& stops() const { return stops_; }
  /// Parts of the demand that could not be met: no roads, no models, more vehicles than room.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Number of objects that `add_vehicles` appends.
  std::size_t vehicle_count() const { return simulation_->vehicles().size(); }
  const Simulation& simulation() const { return *simulation_; }  ///< for tests and benches
  Simulation& simulation() { return *simulation_; }              ///< likewise, for their controls

 private:
  /// Lamps that are lit together.
  struct Lamps {
    std::size_t object = 0, junction = 0;
    int phase = 0;
    bool is_for_people = false, is_visible = true;
    DriveLight drive = DriveLight::red;
    scene::WalkLight walk = scene::WalkLight::none;
    int crossing = 0;  ///< one of those whose lights they are
  };
  bool is_lit(const Lamps& lamps) const;
  void add_bus_stops(const scene::Scene& scene);

  std::unique_ptr<Simulation> simulation_;
  std::shared_ptr<std::vector<scene::TransitStop>> stops_ =
      std::make_shared<std::vector<scene::TransitStop>>();
  std::vector<Lamps> lamps_;
  std::vector<bool> junction_visible_;  ///< of each junction with lights
  std::vector<std::string> warnings_;
  std::size_t first_object_ = 0;
};

}  // namespace parvis::traffic
