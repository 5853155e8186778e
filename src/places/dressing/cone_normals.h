// Normals of conical roofs, which files have as triangles around a point.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "places/dressing/model_triangles.h"

namespace parvis::dressing {

/// For each triangle of `roofs` that is one of 12 or more around the top of a cone, the normals of its
/// corners: unit, in the model's frame, halfway to the next triangle's where they turn by up to 30 degrees.
/// Pyramids of fewer sides have edges.
std::vector<std::optional<std::array<glm::vec3, 3>>> cone_normals(const std::vector<ModelTriangle>& roofs);

}  // namespace parvis::dressing
