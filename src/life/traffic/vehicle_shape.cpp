#include "life/traffic/vehicle_shape.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

namespace parvis::traffic {

namespace {

bool names_a_wheel(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return name.find("wheel") != std::string::npos;
}

/// Whether `node` is `ancestor` or hangs below it.
bool hangs_on(const scene::Model& model, int node, int ancestor) {
  while (node > ancestor) node = model.nodes[std::size_t(node)].parent;
  return node == ancestor;
}

/// Bounds, in the model's frame, of what hangs on a node.
Bounds bounds_of(const VehicleShape& shape, int node) {
  Bounds bounds;
  for (const scene::Part& part : shape.model->parts)
    if (hangs_on(*shape.model, part.node, node))
      bounds.add(transformed(shape.rest_pose[std::size_t(part.node)], part.mesh.bounds()));
  return bounds;
}

/// Width over tyres and wings: mirrors stand out above, but pass over and between those of others.
void find_width(VehicleShape& shape, const Bounds& bounds) {
  const float mirrors_begin_m = bounds.min.z + 0.45f * bounds.size().z;
  Bounds low;
  for (const scene::Part& part : shape.model->parts)
    for (const glm::vec3& position : part.mesh.positions) {
      const glm::vec3 p(shape.rest_pose[std::size_t(part.node)] * glm::vec4(position, 1.0f));
      if (p.z < mirrors_begin_m) low.add(p);
    }
  shape.half_width_m = 0.5f * low.size().y;
  shape.middle_y_m = low.centre().y;
}

void find_wheels(VehicleShape& shape) {
  const std::vector<scene::ModelNode>& nodes = shape.model->nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const int parent = nodes[i].parent;
    const bool is_inside_wheel = parent != scene::no_index && names_a_wheel(nodes[std::size_t(parent)].name);
    if (!names_a_wheel(nodes[i].name) || is_inside_wheel) continue;
    const Bounds bounds = bounds_of(shape, int(i));
    // A spare wheel hangs clear of the ground.
    if (bounds.empty() || bounds.min.z > shape.ground_z_m + 0.25f * bounds.size().z) continue;
    shape.wheels.push_back({int(i), bounds.centre(), std::max(0.5f * bounds.size().z, 0.05f), false});
  }
}

void find_axles(VehicleShape& shape) {
  const float middle = 0.5f * (shape.front_m + shape.rear_m);
  shape.front_axle_m = middle + 0.3f * shape.length_m();
  shape.rear_axle_m = middle - 0.3f * shape.length_m();
  if (shape.wheels.empty()) return;
  const auto [rear, front] =
      std::ranges::minmax(shape.wheels, {}, [](const Wheel& w) { return w.centre_in_model.x; });
  const float rear_x = rear.centre_in_model.x, front_x = front.centre_in_model.x;
  if (front_x - rear_x < 0.2f * shape.length_m()) return;  // one axle alone says nothing
  shape.front_axle_m = front_x;
  shape.rear_axle_m = rear_x;
  for (Wheel& wheel : shape.wheels) wheel.is_front = wheel.centre_in_model.x > 0.5f * (front_x + rear_x);
}

}  // namespace

VehicleShape vehicle_shape(std::shared_ptr<const scene::Model> model) {
  VehicleShape shape;
  shape.rest_pose = scene::rest_pose(*model);
  const Bounds bounds = scene::bounds(*model);
  shape.model = std::move(model);
  if (!bounds.empty()) {
    shape.front_m = bounds.max.x, shape.rear_m = bounds.min.x;
    shape.ground_z_m = bounds.min.z;
    find_width(shape, bounds);
  }
  find_wheels(shape);
  find_axles(shape);
  return shape;
}

glm::mat4 VehicleShape::world_from_model(glm::vec3 rear_axle_in_world, glm::vec3 front_axle_in_world) const {
  const glm::vec3 forward = glm::normalize(front_axle_in_world - rear_axle_in_world);
  const glm::vec3 left = glm::normalize(glm::cross(glm::vec3(0.0f, 0.0f, 1.0f), forward));
  const glm::mat3 rotation(forward, left, glm::cross(forward, left));
  const glm::vec3 origin = rear_axle_in_world - rotation * glm::vec3(rear_axle_m, middle_y_m, ground_z_m);
  glm::mat4 result(rotation);
  result[3] = glm::vec4(origin, 1.0f);
  return result;
}

Footprint VehicleShape::footprint(glm::vec3 rear_axle_in_world, glm::vec3 front_axle_in_world) const {
  const glm::vec2 rear(rear_axle_in_world), forward = glm::normalize(glm::vec2(front_axle_in_world) - rear);
  const float rear_to_centre_m = 0.5f * (front_m + rear_m) - rear_axle_m;
  return {rear + forward * rear_to_centre_m, forward, 0.5f * length_m(), half_width_m};
}

void VehicleShape::set_pose(double travelled_m, float steering, std::vector<glm::mat4>& pose) const {
  std::ranges::copy(rest_pose, pose.begin());
  for (const Wheel& wheel : wheels) {
    const double turns = travelled_m / (glm::two_pi<double>() * double(wheel.radius_m));
    const float spin = float((turns - std::floor(turns)) * glm::two_pi<double>());
    glm::mat4 turned = glm::translate(glm::mat4(1.0f), wheel.centre_in_model);
    if (wheel.is_front) turned = glm::rotate(turned, steering, glm::vec3(0.0f, 0.0f, 1.0f));
    turned = glm::rotate(turned, spin, glm::vec3(0.0f, 1.0f, 0.0f));
    turned = glm::translate(turned, -wheel.centre_in_model);
    for (std::size_t node = std::size_t(wheel.node); node < pose.size(); ++node)
      if (hangs_on(*model, int(node), wheel.node)) pose[node] = turned * rest_pose[node];
  }
}

VehicleShape bicycle_shape(std::uint64_t number) {
  constexpr float length_m = 1.78f, half_width_m = 0.33f;
  constexpr float slowest_m_s = 4.2f, fastest_m_s = 6.1f;  // 15 to 22 km/h: by number
  const auto rider = std::make_shared<const people::Cyclist>(number);
  VehicleShape shape = vehicle_shape(rider->model());
  // The mesh at rest stands with its arms spread.
  shape.front_m = 0.5f * length_m, shape.rear_m = -0.5f * length_m;
  shape.half_width_m = half_width_m, shape.middle_y_m = 0.0f, shape.ground_z_m = 0.0f;
  shape.max_speed_m_s = std::lerp(slowest_m_s, fastest_m_s, float(number % 8) / 7.0f);
  shape.rider = rider;
  return shape;
}

}  // namespace parvis::traffic
