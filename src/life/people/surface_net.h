// Meshes of implicit surfaces: naive surface nets (Gibson 1998, "Constrained elastic surface nets") whose
// vertices are then moved onto the surface, and clipping along a second function.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <numbers>

#include "base/mesh.h"

namespace parvis::people {

inline constexpr float pi = std::numbers::pi_v<float>;

/// Approximate distance to a surface, metres; negative inside. Its slope is about 1 and nowhere above 1.5.
using Field = std::function<float(glm::vec3)>;

/// The smaller of two fields, rounded where they differ by less than `width` (Inigo Quilez's polynomial
/// smooth minimum).
inline float smooth_min(float a, float b, float width) {
  const float h = std::max(width - std::abs(a - b), 0.0f) / width;
  return std::min(a, b) - 0.25f * h * h * width;
}
/// The larger of two fields, rounded.
inline float smooth_max(float a, float b, float width) { return -smooth_min(-a, -b, width); }

/// Distance to a cone between two spheres, about; exact where the radii are equal.
float round_cone(glm::vec3 p, glm::vec3 a, glm::vec3 b, float ra, float rb);
/// Approximate distance to an ellipsoid.
float ellipsoid(glm::vec3 p, glm::vec3 centre, glm::vec3 radii);

/// Smooth noise about 0 between -1 and 1 with features of size 1.
float smooth_noise(glm::vec3 p);

/// The unit gradient of a field.
glm::vec3 normal_of(const Field& field, glm::vec3 p, float step_m = 0.002f);

/// The surface of a field within a box, in cells of `cell_m`; normals are those of the field.
Mesh surface_net(const Field& field, glm::vec3 low, glm::vec3 high, float cell_m);
/// The same in cells whose sides differ: thin upright things keep their shape in cells that are high.
Mesh surface_net(const Field& field, glm::vec3 low, glm::vec3 high, glm::vec3 cell);

/// The part of a mesh in which `keep` is negative, cut along its zeros.
Mesh clipped(const Mesh& mesh, const Field& keep);

}  // namespace parvis::people
