#include "capture/facades/plane_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "base/random.h"

namespace parvis::facades {
namespace {

using photographs::OrientedPoint;

constexpr int hypotheses = 600;
constexpr std::size_t max_planes = 32;
constexpr double min_flatness = 0.5;
constexpr double max_wall_slope = 0.25, min_ground_slope = 0.985;  // of the normal's upward part
constexpr double min_agreement = 0.8;  // cosine between a point's normal and its plane's
constexpr double grid_tolerance_deg = 4.0;

std::optional<SurfaceKind> kind_of(double upward) {
  if (std::abs(upward) < max_wall_slope) return SurfaceKind::wall;
  if (upward >= min_ground_slope) return SurfaceKind::ground;
  if (upward >= max_wall_slope) return SurfaceKind::roof;
  return std::nullopt;  // a ceiling: seen from below
}

/// Searches one plane after the other among points that lie in none yet.
class PlaneSearch {
 public:
  PlaneSearch(const std::vector<OrientedPoint>& points, glm::dvec3 up, double tolerance)
      : points_(points), up_(up), tolerance_(tolerance), is_free_(points.size(), true) {}

  /// The plane with the most points whose hypothesis `accepts` and `penalty` allow, fitted; nothing below
  /// `min_points`.
  template <class Accepts, class Penalty>
  std::optional<FoundPlane> best(std::size_t min_points, Accepts&& accepts, Penalty&& penalty) {
    std::vector<std::size_t> candidates;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (is_free_[i] && points_[i].flatness > min_flatness && accepts(points_[i])) candidates.push_back(i);
    if (candidates.size() < min_points) return std::nullopt;
    std::vector<FoundPlane> planes(hypotheses);
    std::vector<double> scores(hypotheses);
    std::vector<std::size_t> seeds(hypotheses);
    for (std::size_t& seed : seeds) seed = candidates[std::size_t(random_.index(int(candidates.size())))];
    parallel_for(hypotheses, [&](std::size_t h) {
      planes[h] = hypothesis(points_[seeds[h]]);
      scores[h] = double(count(planes[h])) - penalty(planes[h]);
    });
    const std::size_t chosen = std::size_t(std::ranges::max_element(scores) - scores.begin());
    FoundPlane plane = planes[chosen];
    for (int round = 0; round < 4; ++round) fit(plane);
    collect(plane);
    if (plane.inliers.size() < min_points) return std::nullopt;
    return plane;
  }

  /// Its points lie in no other plane from now on.
  void take(const FoundPlane& plane) {
    for (const std::size_t i : plane.inliers) is_free_[i] = false;
  }
  void collect(FoundPlane& plane) const {
    plane.inliers.clear();
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (is_free_[i] && lies_in(plane, points_[i])) plane.inliers.push_back(i);
  }

 private:
  FoundPlane hypothesis(const OrientedPoint& seed) const {
    FoundPlane plane;
    const double upward = glm::dot(seed.normal, up_);
    plane.kind = kind_of(upward).value_or(SurfaceKind::wall);
    plane.normal = plane.kind == SurfaceKind::wall ? glm::normalize(seed.normal - upward * up_) : seed.normal;
    plane.offset = glm::dot(plane.normal, seed.position);
    return plane;
  }
  bool lies_in(const FoundPlane& plane, const OrientedPoint& point) const {
    if (std::abs(glm::dot(plane.normal, point.position) - plane.offset) > tolerance_) return false;
    const double agreement = glm::dot(plane.normal, point.normal);
    return agreement > (point.flatness > min_flatness ? min_agreement : 0.0);
  }
  std::size_t count(const FoundPlane& plane) const {
    std::size_t inside = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) inside += is_free_[i] && lies_in(plane, points_[i]);
    return inside;
  }
  /// Least squares over its points; walls stay upright.
  void fit(FoundPlane& plane) const {
    collect(plane);
    if (plane.inliers.size() < 3) return;
    glm::dvec3 mean(0.0);
    for (const std::size_t i : plane.inliers) mean += points_[i].position / double(plane.inliers.size());
    glm::dmat3 spread(0.0);
    for (const std::size_t i : plane.inliers) {
      glm::dvec3 d = points_[i].position - mean;
      if (plane.kind == SurfaceKind::wall) d -= glm::dot(d, up_) * up_;
      spread += glm::outerProduct(d, d);
    }
    if (plane.kind == SurfaceKind::wall)  // so that the direction without spread is not `up`
      spread += (spread[0][0] + spread[1][1] + spread[2][2] + 1.0) * glm::outerProduct(up_, up_);
    const glm::dvec3 normal = photographs::eigen_of(spread).vectors[0];
    plane.normal = glm::dot(normal, plane.normal) < 0.0 ? -normal : normal;
    plane.offset = glm::dot(plane.normal, mean);
  }

  const std::vector<OrientedPoint>& points_;
  glm::dvec3 up_;
  double tolerance_;
  std::vector<bool> is_free_;
  Random random_{7};
};

/// The heading (radians, in [0, 90 degrees)) of the right-angled grid that most wall points agree with.
double grid_heading(const std::vector<FoundPlane>& planes, glm::dvec3 east, glm::dvec3 north) {
  glm::dvec2 sum(0.0);
  for (const FoundPlane& plane : planes) {
    if (plane.kind != SurfaceKind::wall) continue;
    const double heading = std::atan2(glm::dot(plane.normal, north), glm::dot(plane.normal, east));
    sum += double(plane.inliers.size()) * glm::dvec2(std::cos(4.0 * heading), std::sin(4.0 * heading));
  }
  return 0.25 * std::atan2(sum.y, sum.x);
}

/// Turns walls, and the level part of roofs' normals, to the grid where they are near it.
void align_to_grid(std::vector<FoundPlane>& planes, const std::vector<OrientedPoint>& points, glm::dvec3 up) {
  const glm::dvec3 east = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), up)),
                   north = glm::cross(up, east);
  const double grid = grid_heading(planes, east, north), quarter = glm::radians(90.0);
  for (FoundPlane& plane : planes) {
    if (plane.kind == SurfaceKind::ground || plane.inliers.empty()) continue;
    const double heading = std::atan2(glm::dot(plane.normal, north), glm::dot(plane.normal, east));
    const double nearest = grid + quarter * std::round((heading - grid) / quarter);
    if (std::abs(heading - nearest) > glm::radians(grid_tolerance_deg)) continue;
    const double upward = glm::dot(plane.normal, up), level = std::sqrt(std::max(1.0 - upward * upward, 0.0));
    plane.normal = level * (std::cos(nearest) * east + std::sin(nearest) * north) + upward * up;
    plane.offset = 0.0;
    for (const std::size_t i : plane.inliers)
      plane.offset += glm::dot(plane.normal, points[i].position) / double(plane.inliers.size());
  }
}

}  // namespace

std::vector<FoundPlane> find_planes(const std::vector<OrientedPoint>& points, glm::dvec3 up, double tolerance,
                                    const std::vector<glm::dvec3>& camera_positions) {
  PlaneSearch search(points, up, tolerance);
  std::vector<FoundPlane> planes;
  double lowest_camera = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& camera : camera_positions)
    lowest_camera = std::min(lowest_camera, glm::dot(camera, up));
  // The ground has hardly a point below it.
  const auto is_low_and_level = [&](const OrientedPoint& point) {
    return glm::dot(point.normal, up) >= min_ground_slope && glm::dot(point.position, up) < lowest_camera;
  };
  const auto points_below = [&](const FoundPlane& plane) {
    double below = 0.0;
    for (const OrientedPoint& point : points)
      below += glm::dot(plane.normal, point.position) < plane.offset - 3.0 * tolerance;
    return 2.0 * below;
  };
  const std::size_t min_ground = std::max<std::size_t>(20, points.size() / 500);
  if (auto ground = search.best(min_ground, is_low_and_level, points_below)) {
    search.take(*ground);
    planes.push_back(std::move(*ground));
  }
  const std::size_t min_points = std::max<std::size_t>(30, points.size() / 150);
  const auto is_wall_or_roof = [&](const OrientedPoint& point) {
    const auto kind = kind_of(glm::dot(point.normal, up));
    return kind && *kind != SurfaceKind::ground;
  };
  while (planes.size() < max_planes) {
    auto plane = search.best(min_points, is_wall_or_roof, [](const FoundPlane&) { return 0.0; });
    if (!plane) break;
    search.take(*plane);
    planes.push_back(std::move(*plane));
  }
  align_to_grid(planes, points, up);
  return planes;
}

}  // namespace parvis::facades
