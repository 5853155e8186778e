// Lines of a plan from meshes: sections, edges, outlines from above.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "base/mesh.h"

namespace parvis::plan_drawing {

using Segment = std::array<glm::dvec3, 2>;

/// Where a mesh is cut at `above_m` over the ground: in each triangle the line between its corners above and
/// below. `ground_m`: height of the ground at a place.
void add_section(const Mesh& mesh, const glm::mat4& world_from_mesh,
                 const std::function<float(glm::vec2)>& ground_m, float above_m,
                 std::vector<Segment>& segments);

/// The edges that one triangle alone has: the rim of a road.
void add_open_edges(const Mesh& mesh, const glm::mat4& world_from_mesh, std::vector<Segment>& segments);

/// Polylines of segments that meet within a millimetre in plan; double ones count once, and points on
/// straight lines are left out. A closed one has its first point again at the end.
std::vector<std::vector<glm::dvec3>> joined(const std::vector<Segment>& segments);

/// The convex outline of points from above, counter-clockwise, the first point again at the end, at the
/// lowest height; empty where they have no area.
std::vector<glm::dvec3> convex_outline(std::vector<glm::dvec3> points);

}  // namespace parvis::plan_drawing
