// How much work a polygon makes for the tessellator, found before it begins.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace parvis::scene {

/// Crossings and overlaps of edges that a surface may have: its triangles grow with their number, which grows
/// with the square of its points, and the tessellator's time with more. What real files hold are slips of the
/// pen, a handful a surface.
inline constexpr std::size_t max_edge_crossings = 2000;

/// Points times rings that a surface may have: with every hole the tessellator walks what it has joined so
/// far. That of 7,000 holes of four corners takes some seconds.
inline constexpr std::size_t max_ring_points = 200'000'000;

/// Whether the surface has no more than `max_ring_points`, and its edges, seen along `normal`, cross or
/// overlap each other at most `max_edge_crossings` times, and lie beside each other so seldom that this can
/// be found out. Edges that share a point of a ring do not cross there. A sweep along one axis over edges
/// sorted by their beginning: time of n log n for outlines, and bounded for all.
bool can_be_triangulated(const std::vector<std::vector<glm::dvec3>>& rings, glm::dvec3 normal);

}  // namespace parvis::scene
