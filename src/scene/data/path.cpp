#include "scene/data/path.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace parvis::scene {

namespace {

constexpr float same_point_m = 1e-3f;
constexpr float largest_turn = glm::radians(6.0f);  // between the chords of an arc: looks round, costs little
constexpr float curve_step_m = 0.5f;

glm::vec2 in_plan(glm::vec3 v) { return {v.x, v.y}; }

/// Appends the arc that rounds the corner between `before` and `after`.
void append_corner(Path& result, glm::vec3 before, glm::vec3 corner, glm::vec3 after, float radius_m) {
  const glm::vec3 back = before - corner, ahead = after - corner;
  const float back_m = glm::length(back), ahead_m = glm::length(ahead);
  const float cosine = std::clamp(glm::dot(back, ahead) / (back_m * ahead_m), -1.0f, 1.0f);
  const float turn = glm::pi<float>() - std::acos(cosine);
  if (turn < 0.5f * largest_turn) return result.push_back(corner);

  // The arc touches both segments at `tangent_m` from the corner; neighbouring corners share a segment half
  // and half.
  const float tangent_m =
      std::min({radius_m * std::tan(0.5f * std::min(turn, 3.0f)), 0.499f * back_m, 0.499f * ahead_m});
  const glm::vec3 start = corner + back * (tangent_m / back_m);
  const glm::vec3 end = corner + ahead * (tangent_m / ahead_m);
  const glm::vec3 inward = glm::normalize(back / back_m + ahead / ahead_m + glm::vec3(1e-12f));
  const glm::vec3 centre = corner + inward * (tangent_m / std::max(std::sin(0.5f * turn), 1e-6f));
  const int steps = std::max(1, int(std::ceil(turn / largest_turn)));
  const float radius = glm::length(start - centre);
  for (int i = 0; i <= steps; ++i) {
    const glm::vec3 on_chord = glm::mix(start, end, float(i) / float(steps));
    const glm::vec3 from_centre = on_chord - centre;
    const float distance = glm::length(from_centre);
    result.push_back(distance > 1e-6f && i > 0 && i < steps ? centre + from_centre * (radius / distance)
                                                            : on_chord);
  }
}

}  // namespace

MeasuredPath::MeasuredPath(Path points) : points_(std::move(points)) {
  assert(points_.size() >= 2);
  distances_.resize(points_.size(), 0.0f);
  for (std::size_t i = 1; i < points_.size(); ++i)
    distances_[i] = distances_[i - 1] + glm::distance(points_[i - 1], points_[i]);
}

MeasuredPath MeasuredPath::in_plan(Path points) {
  MeasuredPath path(std::move(points));
  for (std::size_t i = 1; i < path.points_.size(); ++i)
    path.distances_[i] =
        path.distances_[i - 1] + glm::distance(glm::vec2(path.points_[i - 1]), glm::vec2(path.points_[i]));
  return path;
}

std::size_t MeasuredPath::segment_at(float distance) const {
  const auto after = std::upper_bound(distances_.begin() + 1, distances_.end() - 1, distance);
  return std::size_t(after - distances_.begin()) - 1;
}

glm::vec3 MeasuredPath::at(float distance) const {
  const std::size_t i = segment_at(distance);
  const float share = (distance - distances_[i]) / (distances_[i + 1] - distances_[i]);
  return glm::mix(points_[i], points_[i + 1], share);
}

glm::vec3 MeasuredPath::direction_at(float distance) const {
  const std::size_t i = segment_at(distance);
  return glm::normalize(points_[i + 1] - points_[i]);
}

Path MeasuredPath::part(float from, float to) const {
  assert(from < to);
  Path result{at(from)};
  // Distances are finer than floats know points many kilometres from the origin: these may coincide.
  const auto is_last = [&](const glm::vec3& point) {
    return glm::distance(glm::vec2(result.back()), glm::vec2(point)) <= same_point_m;
  };
  for (std::size_t i = segment_at(from); i < points_.size() && distances_[i] < to - same_point_m; ++i)
    if (distances_[i] > from + same_point_m && !is_last(points_[i])) result.push_back(points_[i]);
  const glm::vec3 end = at(to);
  if (result.size() > 1 && is_last(end)) result.pop_back();
  result.push_back(end);
  return result;
}

Path without_repeats(std::span<const glm::vec3> path) {
  Path result;
  for (const glm::vec3& point : path)
    if (result.empty() || glm::distance(in_plan(result.back()), in_plan(point)) > same_point_m)
      result.push_back(point);
  return result;
}

Path rounded(const Path& path, float radius_m) {
  Path result{path.front()};
  for (std::size_t i = 1; i + 1 < path.size(); ++i)
    append_corner(result, path[i - 1], path[i], path[i + 1], radius_m);
  result.push_back(path.back());
  return without_repeats(result);
}

Path parallel(const Path& path, float distance_m) {
  Path result;
  glm::vec3 last_kept(0.0f);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const glm::vec3 arriving = right_of(i > 0 ? path[i] - path[i - 1] : path[i + 1] - path[i]);
    const glm::vec3 leaving = right_of(i + 1 < path.size() ? path[i + 1] - path[i] : path[i] - path[i - 1]);
    // The miter of both sides, limited where the path nearly turns back.
    const glm::vec3 middle = arriving + leaving;
    const float miter = std::min(2.0f / std::max(glm::dot(middle, middle), 1e-6f), 1.0f);
    const glm::vec3 shifted = path[i] + middle * (miter * distance_m);
    const bool runs_backward =
        !result.empty() && glm::dot(in_plan(shifted - result.back()), in_plan(path[i] - last_kept)) <= 0.0f;
    if (runs_backward && i + 1 < path.size()) continue;
    if (runs_backward && result.size() > 1) result.pop_back();  // the end stays where it belongs
    result.push_back(shifted);
    last_kept = path[i];
  }
  return result;
}

Path turning_curve(glm::vec3 start, glm::vec3 start_direction, glm::vec3 end, glm::vec3 end_direction) {
  const glm::vec3 chord = end - start;
  const float distance = glm::length(chord);
  const float sine = cross_in_plan(start_direction, end_direction);
  const float turn = std::atan2(std::abs(sine), glm::dot(in_plan(start_direction), in_plan(end_direction)));

  // Handles of the cubic that follows a circle, from where the two straight lines meet; without a meeting
  // ahead of both (a sidestep), a third of the way.
  float start_handle = 0.4f * distance, end_handle = start_handle;
  if (turn > 0.05f && turn < 2.9f) {
    const float to_meeting = cross_in_plan(chord, end_direction) / sine;
    const float from_meeting = cross_in_plan(start_direction, chord) / sine;
    if (to_meeting > 0.0f && from_meeting > 0.0f && std::max(to_meeting, from_meeting) < 3.0f * distance) {
      const float factor = 4.0f / 3.0f * std::tan(0.25f * turn) / std::tan(0.5f * turn);
      start_handle = factor * to_meeting;
      end_handle = factor * from_meeting;
    }
  }
  const glm::vec3 p1 = start + start_direction * start_handle;
  const glm::vec3 p2 = end - end_direction * end_handle;

  const int steps = std::clamp(int(std::ceil(1.2f * distance / curve_step_m)), 2, 200);
  Path result;
  for (int i = 0; i <= steps; ++i) {
    const float t = float(i) / float(steps), u = 1.0f - t;
    result.push_back(u * u * u * start + 3.0f * u * u * t * p1 + 3.0f * u * t * t * p2 + t * t * t * end);
  }
  return result;
}

}  // namespace parvis::scene
