// Properties of a vehicle's model that driving needs: length, axles, wheels.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "life/people/cyclist.h"
#include "life/traffic/footprint.h"
#include "scene/data/scene.h"

namespace parvis::traffic {

/// A wheel of the model.
struct Wheel {
  int node = 0;  ///< of the model; its descendants turn with it
  glm::vec3 centre_in_model{0.0f};
  float radius_m = 0.3f;
  bool is_front = false;  ///< steers
};

/// A model that drives along its +x axis. Lengths along x are measured from the model's origin.
struct VehicleShape {
  std::shared_ptr<const scene::Model> model;
  std::vector<glm::mat4> rest_pose;
  std::vector<Wheel> wheels;
  float front_m = 2.0f, rear_m = -2.0f;  ///< bumpers
  float front_axle_m = 1.3f, rear_axle_m = -1.3f;
  float half_width_m = 0.9f;
  float middle_y_m = 0.0f;
  float ground_z_m = 0.0f;  ///< lowest point of the model
  float max_speed_m_s = std::numeric_limits<float>::max();
  std::shared_ptr<const people::Cyclist> rider;  ///< of a bicycle; null: what has a motor

  /// Length over the bumpers, metres.
  float length_m() const { return front_m - rear_m; }
  /// Distance between the axles, metres.
  float wheelbase_m() const { return front_axle_m - rear_axle_m; }
  /// Distance from the front axle to the front bumper, metres.
  float front_overhang_m() const { return front_m - front_axle_m; }

  /// Transform of the vehicle when its axles are at two points on the ground.
  glm::mat4 world_from_model(glm::vec3 rear_axle_in_world, glm::vec3 front_axle_in_world) const;
  /// Outline on the ground when its axles are at two points.
  Footprint footprint(glm::vec3 rear_axle_in_world, glm::vec3 front_axle_in_world) const;

  /// Writes model_from_node of every node: wheels rotated by `travelled_m`, front wheels steered by
  /// `steering` (radians, positive to the left). `pose` has one entry per node.
  void set_pose(double travelled_m, float steering, std::vector<glm::mat4>& pose) const;
};

/// Derives the shape from a model. Wheels are nodes whose names contain "wheel" (any case) and whose parents'
/// names do not; a model without wheels gets axles at 30 % of its length from the middle.
VehicleShape vehicle_shape(std::shared_ptr<const scene::Model> model);
/// A bicycle and its rider, by a number.
VehicleShape bicycle_shape(std::uint64_t number);

}  // namespace parvis::traffic
