// Straight skeletons: where the edges of an outline meet that move inward at one speed.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace parvis::scene {

/// Twice the signed area of the triangle 0, a, b: positive where b is to the left of a.
inline double cross_in_plan(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// The faces of a roof that rises from all edges of an outline with one slope.
struct StraightSkeleton {
  /// Points of the skeleton: x and y in plan, metres; z: distance from the outline's edges at which the
  /// moving edges reach the point.
  std::vector<glm::dvec3> points;
  /// One face per edge, in the order of the rings' edges: indices of points, counter-clockwise, the ends of
  /// the edge first.
  std::vector<std::vector<int>> faces;

  double highest_m() const;  ///< the largest z of `points`
};

/// Corners of an outline up to which a skeleton is sought: the time grows with their cube.
inline constexpr std::size_t max_skeleton_corners = 150;

/// The straight skeleton (Aichholzer and others 1995, "A novel type of skeleton for polygons") of an outline,
/// counter-clockwise, and its holes, clockwise. Nothing for rings that cross themselves or each other, or
/// have more corners than `max_skeleton_corners`; points that lie within 5 mm of each other may be one.
///
/// Departure: events are not told apart into collapsed and split edges. At the time of the earliest one all
/// edges are moved there, what touches is joined, and the edges that remain are linked in the order of their
/// angles. So any number of events may coincide, as they do in buildings, where most angles are right.
std::optional<StraightSkeleton> straight_skeleton(const std::vector<std::vector<glm::dvec2>>& rings);

}  // namespace parvis::scene
