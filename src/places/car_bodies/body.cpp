#include "places/car_bodies/body.h"

#include <algorithm>
#include <limits>

#include "base/median.h"

namespace parvis::car_bodies {
namespace {

/// The median, over slices along the car, of the middle between the outermost points of both sides.
float middle_of(const Body& body) {
  constexpr int slices = 48;
  constexpr float lowest = std::numeric_limits<float>::lowest();
  std::vector<std::pair<float, float>> sides(slices, {-lowest, lowest});
  const Bounds& bounds = body.bounds();
  const float step = bounds.size().x / float(slices);
  if (!(step > 0.0f)) return bounds.centre().y;
  for (std::size_t part = 0; part < body.model().parts.size(); ++part)
    for (std::size_t i = 0; i < body.model().parts[part].mesh.triangle_count(); ++i)
      visit_points(body.corners(part, i), step, [&](glm::vec3 at) {
        auto& [low, high] = sides[std::size_t(std::clamp(int((at.x - bounds.min.x) / step), 0, slices - 1))];
        low = std::min(low, at.y), high = std::max(high, at.y);
      });
  std::vector<float> middles;
  middles.reserve(slices);
  for (const auto& [low, high] : sides)
    if (low <= high) middles.push_back(0.5f * (low + high));
  return median(std::move(middles));
}

}  // namespace

Body::Body(const scene::Model& model, const glm::mat4& car_from_model)
    : model_(model), pose_(scene::rest_pose(model)) {
  for (glm::mat4& each : pose_) each = car_from_model * each;
  for (std::size_t part = 0; part < model.parts.size(); ++part)
    for (std::size_t i = 0; i < model.parts[part].mesh.triangle_count(); ++i)
      for (const glm::vec3& corner : corners(part, i)) bounds_.add(corner);
  if (!bounds_.empty()) middle_y_ = middle_of(*this);
}

std::array<glm::vec3, 3> Body::corners(std::size_t part, std::size_t triangle) const {
  const Mesh& mesh = part_of(part).mesh;
  std::array<glm::vec3, 3> at;
  for (std::size_t k = 0; k < 3; ++k)
    at[k] = glm::vec3(car_from_part(part) * glm::vec4(mesh.positions[mesh.indices[3 * triangle + k]], 1.0f));
  return at;
}

}  // namespace parvis::car_bodies
