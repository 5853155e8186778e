#include "life/crowd/avoidance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace parvis::crowd {
namespace {

constexpr float parallel = 1e-6f;  ///< sines below it
constexpr std::size_t max_planes = 24;

float cross(glm::vec2 a, glm::vec2 b) { return a.x * b.y - a.y * b.x; }
glm::vec2 left_of(glm::vec2 v) { return {-v.y, v.x}; }

/// A goal on a boundary: the point nearest to `target`, or the one farthest along it.
struct Goal {
  glm::vec2 target;
  bool is_direction = false;
};

/// The best velocity on the boundary of `planes[number]` that lies in the disc of speeds and in all planes
/// before it. False where there is none.
bool best_on_boundary(std::span<const VelocityHalfPlane> planes, std::size_t number, float max_speed,
                      const Goal& goal, glm::vec2& best) {
  const VelocityHalfPlane& line = planes[number];
  const glm::vec2 along = left_of(line.normal);
  const float middle = -glm::dot(line.point, along), across = glm::dot(line.point, line.normal);
  const float under_root = max_speed * max_speed - across * across;
  if (under_root < 0.0f) return false;
  const float half = std::sqrt(under_root);
  float from = middle - half, to = middle + half;
  for (std::size_t i = 0; i < number; ++i) {
    const float rise = glm::dot(along, planes[i].normal);
    const float height = planes[i].distance(line.point);
    if (std::abs(rise) < parallel) {
      if (height < 0.0f) return false;
      continue;
    }
    const float at = -height / rise;
    if (rise > 0.0f)
      from = std::max(from, at);
    else
      to = std::min(to, at);
    if (from > to) return false;
  }
  const float wanted = goal.is_direction ? (glm::dot(goal.target, along) > 0.0f ? to : from)
                                         : std::clamp(glm::dot(goal.target - line.point, along), from, to);
  best = line.point + wanted * along;
  return true;
}

/// The best velocity in the disc of speeds and in all planes. Returns their number, or that of the first
/// plane with which there is none: `best` then is that of the planes before it.
std::size_t best_in(std::span<const VelocityHalfPlane> planes, float max_speed, const Goal& goal,
                    glm::vec2& best) {
  if (goal.is_direction) {
    best = goal.target * max_speed;
  } else {
    const float speed = glm::length(goal.target);
    best = speed > max_speed ? goal.target * (max_speed / speed) : goal.target;
  }
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (planes[i].distance(best) >= 0.0f) continue;
    const glm::vec2 before = best;
    if (!best_on_boundary(planes, i, max_speed, goal, best)) {
      best = before;
      return i;
    }
  }
  return planes.size();
}

/// Where no velocity is in all planes: the one whose greatest violation of the planes from `failed` on is
/// least (a linear programme in three dimensions, plane by plane).
void minimize_violation(std::span<const VelocityHalfPlane> planes, std::size_t hard, std::size_t failed,
                        float max_speed, glm::vec2& best) {
  float violation = 0.0f;
  std::array<VelocityHalfPlane, max_planes> projected;
  for (std::size_t i = std::max(failed, hard); i < planes.size(); ++i) {
    if (-planes[i].distance(best) <= violation) continue;
    std::copy_n(planes.begin(), hard, projected.begin());
    std::size_t count = hard;
    for (std::size_t j = hard; j < i; ++j) {
      // Velocities at which plane j is violated no more than plane i.
      const glm::vec2 difference = planes[j].normal - planes[i].normal;
      const float length = glm::length(difference);
      if (length < parallel) continue;  // the same direction: the farther one, plane i, decides
      const glm::vec2 normal = difference / length;
      const float sine = cross(planes[i].normal, planes[j].normal);
      glm::vec2 point;
      if (std::abs(sine) < parallel) {
        point = 0.5f * (planes[i].point + planes[j].point);  // opposite directions
      } else {
        const glm::vec2 along = left_of(planes[i].normal);
        point = planes[i].point -
                along * (planes[j].distance(planes[i].point) / glm::dot(along, planes[j].normal));
      }
      projected[count++] = {point, normal};
    }
    const glm::vec2 before = best;
    // Rounding may leave nothing where the best so far lies on a border; it then stays.
    if (best_in({projected.data(), count}, max_speed, {planes[i].normal, true}, best) < count) best = before;
    violation = -planes[i].distance(best);
  }
}

}  // namespace

VelocityHalfPlane clear_of_disc(const RelativeDisc& other, glm::vec2 own_velocity, float horizon_s,
                                float step_s, float share) {
  const float distance_2 = glm::dot(other.position, other.position), radius_2 = other.radius * other.radius;
  const bool overlaps = distance_2 <= radius_2;
  // The forbidden relative velocities: a cone about the other's direction, its tip cut off by the disc that
  // the others reach at the horizon.
  const float within_s = overlaps ? step_s : horizon_s;
  const glm::vec2 from_tip = other.velocity - other.position / within_s;
  const float along = glm::dot(from_tip, other.position), length_2 = glm::dot(from_tip, from_tip);
  glm::vec2 normal, change;
  if (overlaps || (along < 0.0f && along * along > radius_2 * length_2)) {
    const float length = std::sqrt(length_2);
    normal = length > 0.0f ? from_tip / length : glm::vec2(1.0f, 0.0f);
    change = (other.radius / within_s - length) * normal;
  } else {
    // The nearer side of the cone: the direction to the other turned by asin(radius / distance).
    const float tangent = std::sqrt(distance_2 - radius_2);
    const float side = cross(other.position, from_tip) > 0.0f ? 1.0f : -1.0f;
    const glm::vec2 edge =
        (other.position * tangent + side * other.radius * left_of(other.position)) / distance_2;
    normal = side * left_of(edge);
    change = glm::dot(other.velocity, edge) * edge - other.velocity;
  }
  return {own_velocity + share * change, normal};
}

VelocityHalfPlane clear_of_wall(glm::vec2 inward, float room_m, float horizon_s, float step_s) {
  return {-inward * (room_m / (room_m < 0.0f ? step_s : horizon_s)), inward};
}

glm::vec2 nearest_velocity(std::span<const VelocityHalfPlane> planes, std::size_t hard, glm::vec2 preferred,
                           float max_speed) {
  planes = planes.first(std::min(planes.size(), max_planes));
  glm::vec2 best;
  const std::size_t failed = best_in(planes, max_speed, {preferred}, best);
  if (failed < planes.size())
    minimize_violation(planes, std::min(hard, planes.size()), failed, max_speed, best);
  return best;
}

}  // namespace parvis::crowd
