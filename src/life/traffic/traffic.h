// Cars, vans and buses on a scene's road graph: they keep to their lanes and their distance, give way at
// crossings, slow down for bends. From a seed and at a fixed step, so that the same scene gives the same
// traffic everywhere.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "life/traffic/demand.h"
#include "life/traffic/simulation.h"
#include "scene/data/scene.h"

namespace parvis::traffic {

/// "vehicle 1" of the vehicle 0, and so on: cameras follow vehicles by these names.
inline std::string vehicle_name(std::size_t vehicle) { return fmt::format("vehicle {}", vehicle + 1); }

class Traffic {
 public:
  /// Reads the scene's roads and traffic demand. Vehicles start spread over the streets and have driven for a
  /// while.
  explicit Traffic(const scene::Scene& scene);

  /// Appends one object per vehicle ("vehicle 1", "vehicle 2", ...) to the scene, where it stands; once.
  void add_vehicles(scene::Scene& scene);
  /// Lets `step_s` pass. Allocates nothing.
  void step() { simulation_->step(); }
  /// Moves the objects that add_vehicles appended to where they were `ahead_s`, from 0 to `step_s`, after the
  /// last step but one: between the last two.
  void place(scene::Scene& scene, double ahead_s) const;

  /// What the demand asked for and did not get: no roads, no models, more vehicles than room.
  const std::vector<std::string>& warnings() const { return warnings_; }

  std::size_t vehicle_count() const { return simulation_->vehicles().size(); }
  const Simulation& simulation() const { return *simulation_; }

 private:
  std::unique_ptr<Simulation> simulation_;
  std::vector<std::string> warnings_;
  std::size_t first_object_ = 0;
};

}  // namespace parvis::traffic
