// Conical roofs, which files have as triangles around a point.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "places/dressing/model_triangles.h"

namespace parvis::dressing {

/// Properties of a triangle that is a side of a cone.
struct ConeSide {
  std::size_t top = 0;               ///< number of its corner at the cone's top
  std::array<glm::vec3, 3> normals;  ///< of its corners: unit, in the model's frame
  float radius_m = 0.0f,
        slope_m = 0.0f;  ///< from the top to the foot, in plan and in space: the cone's means
};

/// Sides of cones among the triangles of `roofs`: those that are 12 or more around the top of a cone. Normals
/// lie halfway to the next triangle's where they turn by up to 30 degrees. Pyramids of fewer sides have
/// edges.
std::vector<std::optional<ConeSide>> cone_sides(const std::vector<ModelTriangle>& roofs);

}  // namespace parvis::dressing
