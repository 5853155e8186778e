#include "capture/view_dependent_objects/view_lookup.h"

namespace parvis::view_dependent_objects {

ViewLookup::ViewLookup(std::shared_ptr<const BlendedModel> model) : model_(std::move(model)) {
  for (const scene::Texture& picture : model_->pictures) pictures_.emplace_back(picture, false);
}

glm::vec4 ViewLookup::colour(const Piece& piece, const PointOnTriangle& at, int passes) const {
  const glm::vec3* c = model_->corners.data() + 3 * at.triangle;
  const glm::vec3 weights(1.0f - at.barycentric.x - at.barycentric.y, at.barycentric.x, at.barycentric.y);
  const glm::vec3 position = weights.x * c[0] + weights.y * c[1] + weights.z * c[2];
  // How the weights change along two steps of the ray's width in the triangle's plane.
  const glm::vec3 u = c[1] - c[0], v = c[2] - c[0], across = glm::cross(u, v);
  const float squared = std::max(glm::dot(across, across), 1e-20f);
  const auto step = [&](glm::vec3 d) {
    const float second = glm::dot(across, glm::cross(d, v)) / squared,
                third = glm::dot(across, glm::cross(u, d)) / squared;
    return glm::vec3(-second - third, second, third);
  };
  const glm::vec3 along = at.width_m * u / std::max(glm::length(u), 1e-12f);
  const glm::vec3 sideways = glm::cross(across, along) / std::sqrt(squared);
  return Text{*this}.blended_colour(piece.first_entry, piece.views, int(at.triangle - piece.first_triangle),
                                    passes, position, at.to_eye, weights, step(along), step(sideways));
}

}  // namespace parvis::view_dependent_objects
