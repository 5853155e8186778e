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
  /// Reads the scene's roads and traffic demand. Vehicles are spread over the streets and have driven for a
  /// while.
  explicit Traffic(const scene::Scene& scene);

  /// Appends one object per vehicle to the scene at its present place. Call it once.
  void add_vehicles(scene::Scene& scene);
  /// Advances the simulation by `step_s`. Allocates no memory.
  void step() { simulation_->step(); }
  /// Shares the scene's streets with people who walk: Simulation::share.
  void share(scene::StreetTraffic& streets) { simulation_->share(streets); }
  /// Places the objects of `add_vehicles` `ahead_s` (0 to `step_s`) after the last step but one: interpolated
  /// between the last two steps.
  void place(scene::Scene& scene, double ahead_s) const;

  /// Parts of the demand that could not be met: no roads, no models, more vehicles than room.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Number of objects that `add_vehicles` appends.
  std::size_t vehicle_count() const { return simulation_->vehicles().size(); }
  const Simulation& simulation() const { return *simulation_; }  ///< for tests and benches

 private:
  std::unique_ptr<Simulation> simulation_;
  std::vector<std::string> warnings_;
  std::size_t first_object_ = 0;
};

}  // namespace parvis::traffic
