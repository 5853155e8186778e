// The cells of a plan that a polygon stands or lies on.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "land/heights/ground_raster.h"

namespace parvis::kerbside {

/// Corners of a convex polygon.
using Corners = std::vector<glm::dvec3>;

/// Calls use(cell, corners) for each cell of the grid under a convex polygon, with the corners of what stands
/// on that cell. What has no area in plan, a wall, stands on the cells along its line. Work is bounded by the
/// cells of the grid that the polygon's plan box covers; a polygon with numbers that are not finite has none.
void each_cell_under(const scene::GroundGrid& grid, Corners polygon,
                     const std::function<void(glm::ivec2, const Corners&)>& use);

}  // namespace parvis::kerbside
