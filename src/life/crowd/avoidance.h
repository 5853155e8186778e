// Optimal reciprocal collision avoidance: the velocities that keep one person clear of another for a time, as
// a half-plane of velocities, and the velocity in all half-planes that is nearest to a preferred one (van den
// Berg, Guy, Lin and Manocha, "Reciprocal n-body collision avoidance", 2011, sections 4 and 5).
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace parvis::crowd {

/// Velocities v with dot(v - point, normal) >= 0 are allowed; m/s.
struct VelocityHalfPlane {
  glm::vec2 point, normal;  ///< normal: unit length

  /// Negative where the velocity is forbidden.
  float distance(glm::vec2 velocity) const { return glm::dot(velocity - point, normal); }
};

/// A disc as another sees it.
struct RelativeDisc {
  glm::vec2 position{0.0f};  ///< of the other's centre from one's own, metres
  glm::vec2 velocity{0.0f};  ///< one's own minus the other's, m/s
  float radius = 0.0f;       ///< the sum of both radii
};

/// The velocities with which the discs do not touch within `horizon_s`, if the other one does the rest.
/// `share`: the part of the change that is one's own, 0.5 between equals and 1 beside what does not give way.
/// Discs that overlap separate within `step_s`.
VelocityHalfPlane clear_of_disc(const RelativeDisc& other, glm::vec2 own_velocity, float horizon_s,
                                float step_s, float share);

/// The velocities with which who is `room_m` (negative: behind it) from a wall does not pass it within
/// `horizon_s`, and is back within `step_s`. `inward`: unit vector away from the wall.
VelocityHalfPlane clear_of_wall(glm::vec2 inward, float room_m, float horizon_s, float step_s);

/// The velocity no faster than `max_speed` in all half-planes that is nearest to `preferred`. Where there is
/// none, the first `hard` half-planes (walls) hold, and the others are violated by the least possible
/// distance. Cost: expected linear in the number of half-planes.
glm::vec2 nearest_velocity(std::span<const VelocityHalfPlane> planes, std::size_t hard, glm::vec2 preferred,
                           float max_speed);

}  // namespace parvis::crowd
