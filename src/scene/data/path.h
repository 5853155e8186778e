// Polylines on the ground: places along them, parts of them, parallels to them, and the round curves that
// vehicles can follow. Lengths are measured along the line in space; directions and offsets lie in plan (seen
// from above).
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace parvis::scene {

using Path = std::vector<glm::vec3>;

/// A polyline of at least two points with its arc length.
class MeasuredPath {
 public:
  MeasuredPath() = default;
  explicit MeasuredPath(Path points);

  const Path& points() const { return points_; }
  float length() const { return distances_.empty() ? 0.0f : distances_.back(); }

  /// The point at `distance` from the start; beyond the ends the end segments go straight on.
  glm::vec3 at(float distance) const;
  /// Unit vector of travel at `distance`.
  glm::vec3 direction_at(float distance) const;
  /// The points between two distances, both ends included; `from` < `to`.
  Path part(float from, float to) const;

 private:
  std::size_t segment_at(float distance) const;

  Path points_;
  std::vector<float> distances_;  ///< of each point from the start
};

/// Without points that lie within a millimetre, in plan, of the one before.
Path without_repeats(std::span<const glm::vec3> path);

/// The path with its corners replaced by arcs of `radius_m`, smaller where the segments are too short, and
/// sampled so that no arc's chord turns by more than 6 degrees.
Path rounded(const Path& path, float radius_m);

/// The parallel at `distance_m` to the right (negative: left). Where the bend is tighter than the distance
/// the parallel would run backward: those points are left out.
Path parallel(const Path& path, float distance_m);

/// A smooth curve from `start` to `end` that leaves and arrives in the given unit directions: close to a
/// circular arc where one fits, sampled every half metre or so.
Path turning_curve(glm::vec3 start, glm::vec3 start_direction, glm::vec3 end, glm::vec3 end_direction);

/// The unit vector to the right of a direction, in plan.
inline glm::vec3 right_of(glm::vec3 direction) {
  return glm::normalize(glm::vec3(direction.y, -direction.x, 0.0f));
}

/// z of the cross product in plan: positive where `b` lies to the left of `a`.
inline float cross_in_plan(glm::vec3 a, glm::vec3 b) { return a.x * b.y - a.y * b.x; }

}  // namespace parvis::scene
