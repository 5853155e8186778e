#include "places/car_bodies/sampling_limit.h"

#include <algorithm>
#include <array>

namespace parvis::car_bodies {
namespace {

constexpr double max_long_triangles = 5000.0;

/// Calls `visit(corners)` for each triangle of a model.
template <class Visit>
void visit_triangles(const scene::Model& model, const Visit& visit) {
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  for (const scene::Part& part : model.parts) {
    const glm::mat4& model_from_part = pose[std::size_t(part.node)];
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      std::array<glm::vec3, 3> corners;
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] =
            glm::vec3(model_from_part * glm::vec4(part.mesh.positions[part.mesh.indices[i + k]], 1.0f));
      visit(corners);
    }
  }
}

}  // namespace

Result<Bounds> bounds_to_sample(const scene::Model& model, const std::string& file) {
  Bounds bounds;
  visit_triangles(model, [&](const std::array<glm::vec3, 3>& corners) {
    for (const glm::vec3& corner : corners) bounds.add(corner);
  });
  if (bounds.empty()) return bounds;
  const double diagonal = double(glm::length(bounds.size()));
  double long_triangles = 0.0;  // samples of a triangle are as many as the square of its longest side
  visit_triangles(model, [&](const std::array<glm::vec3, 3>& corners) {
    const float longest =
        std::max({glm::distance(corners[0], corners[1]), glm::distance(corners[1], corners[2]),
                  glm::distance(corners[2], corners[0])});
    const double fraction = diagonal > 0.0 ? double(longest) / diagonal : 0.0;
    long_triangles += fraction * fraction;
  });
  if (long_triangles <= max_long_triangles) return bounds;
  return error_at(
      {file, 0, 0},
      "its triangles are as much as {:.0f} that are each as long as the whole car; expected at most "
      "{:.0f}. Leave out surfaces that lie on one another, in the program that made it",
      long_triangles, max_long_triangles);
}

}  // namespace parvis::car_bodies
