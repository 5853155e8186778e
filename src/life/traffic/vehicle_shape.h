// What driving needs to know of a vehicle's model: its length, where its axles are, which nodes are wheels.
#pragma once

#include <memory>
#include <vector>

#include "life/traffic/footprint.h"
#include "scene/data/scene.h"

namespace parvis::traffic {

struct Wheel {
  int node = 0;  ///< of the model; its descendants turn with it
  glm::vec3 centre_in_model{0.0f};
  float radius_m = 0.3f;
  bool is_front = false;  ///< steers
};

/// A model that drives along its +x. Lengths along x are measured from the model's origin.
struct VehicleShape {
  std::shared_ptr<const scene::Model> model;
  std::vector<glm::mat4> rest_pose;
  std::vector<Wheel> wheels;
  float front_m = 2.0f, rear_m = -2.0f;  ///< bumpers
  float front_axle_m = 1.3f, rear_axle_m = -1.3f;
  float half_width_m = 0.9f;
  float middle_y_m = 0.0f;
  float ground_z_m = 0.0f;  ///< lowest point of the model

  float length_m() const { return front_m - rear_m; }
  float wheelbase_m() const { return front_axle_m - rear_axle_m; }
  float front_overhang_m() const { return front_m - front_axle_m; }

  /// The vehicle with its axles at two points of the ground.
  glm::mat4 world_from_model(glm::vec3 rear_axle_in_world, glm::vec3 front_axle_in_world) const;
  Footprint footprint(glm::vec3 rear_axle_in_world, glm::vec3 front_axle_in_world) const;

  /// Writes model_from_node of every node: wheels turned by `travelled_m`, front wheels steered by `steering`
  /// (radians, positive to the left). `pose` has one entry a node.
  void set_pose(double travelled_m, float steering, std::vector<glm::mat4>& pose) const;
};

/// Reads the shape off the model. Wheels are the nodes whose names contain "wheel" (any case) and whose
/// parent's name does not; a model without wheels gets axles at 30 % of its length from the middle.
VehicleShape vehicle_shape(std::shared_ptr<const scene::Model> model);

}  // namespace parvis::traffic
