// Polylines on the ground: points and sections along them, parallels, and curves that vehicles can follow.
// Lengths are 3D arc lengths but where they are said to be in plan; directions and offsets are in plan (seen
// from above).
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace parvis::scene {

/// Points of a polyline, metres, in the world.
using Path = std::vector<glm::vec3>;

/// A polyline of at least two points with its arc length.
class MeasuredPath {
 public:
  MeasuredPath() = default;
  explicit MeasuredPath(Path points);
  /// The same whose lengths are those in plan: heights of its points change none of them.
  static MeasuredPath in_plan(Path points);

  const Path& points() const { return points_; }  ///< as given
  /// Arc length, metres; 0 without points.
  float length() const { return distances_.empty() ? 0.0f : distances_.back(); }

  /// The point at arc length `distance`; beyond the ends the end segments are extended.
  glm::vec3 at(float distance) const;
  /// Unit vector of travel at `distance`.
  glm::vec3 direction_at(float distance) const;
  /// The section between two arc lengths, both end points included; `from` < `to`.
  Path part(float from, float to) const;

 private:
  std::size_t segment_at(float distance) const;

  Path points_;
  std::vector<float> distances_;  ///< of each point from the start
};

/// The path without points that are within a millimetre, in plan, of the preceding one.
Path without_repeats(std::span<const glm::vec3> path);

/// The path with its corners replaced by arcs of radius `radius_m`, smaller where the segments are too short;
/// sampled so that the direction changes by at most 6 degrees per chord.
Path rounded(const Path& path, float radius_m);

/// The parallel at `distance_m` to the right (negative: left). Points are left out where the curve is tighter
/// than the distance and the parallel would run backward.
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
