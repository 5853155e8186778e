#include "capture/photographs/oriented_points.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/median.h"
#include "base/parallel.h"

namespace parvis::photographs {
namespace {

constexpr std::size_t max_points = 40'000;
constexpr std::size_t neighbours = 12;

/// The plane of the nearest neighbours of points[i]; the normal's sign is open.
OrientedPoint with_normal(const std::vector<glm::dvec3>& points, std::size_t i) {
  std::vector<std::pair<double, std::size_t>> nearest;
  nearest.reserve(neighbours + 1);
  for (std::size_t j = 0; j < points.size(); ++j) {
    const glm::dvec3 d = points[j] - points[i];
    const double squared = glm::dot(d, d);
    if (nearest.size() == neighbours && squared >= nearest.front().first) continue;
    if (nearest.size() == neighbours) {
      std::ranges::pop_heap(nearest);
      nearest.pop_back();
    }
    nearest.emplace_back(squared, j);
    std::ranges::push_heap(nearest);
  }
  glm::dvec3 mean(0.0);
  for (const auto& [squared, j] : nearest) mean += points[j] / double(nearest.size());
  glm::dmat3 spread(0.0);
  for (const auto& [squared, j] : nearest) spread += glm::outerProduct(points[j] - mean, points[j] - mean);
  const Eigensystem eigen = eigen_of(spread);
  const double first = std::max(eigen.values[0], 0.0), second = eigen.values[1];
  const bool is_a_line = !(second > 1e-3 * eigen.values[2]);  // of which any direction beside it is normal
  return {points[i], eigen.vectors[0], is_a_line ? 0.0 : 1.0 - std::sqrt(first / second), 1};
}

/// Where the cameras stand that see a point; the nearest camera where nobody noted who does.
glm::dvec3 towards_cameras(const SparsePoint& point, const PhotographSet& set) {
  glm::dvec3 sum(0.0);
  for (const Observation& o : point.observations)
    sum += glm::normalize(set.photographs[std::size_t(o.photograph)].position_in_world() -
                          point.position_in_world);
  if (!point.observations.empty()) return sum;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Photograph& photograph : set.photographs) {
    const glm::dvec3 d = photograph.position_in_world() - point.position_in_world;
    if (glm::dot(d, d) < nearest) nearest = glm::dot(d, d), sum = d;
  }
  return sum;
}

}  // namespace

Eigensystem eigen_of(const glm::dmat3& m) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver{Eigen::Map<const Eigen::Matrix3d>(&m[0][0])};
  Eigensystem result;
  Eigen::Map<Eigen::Vector3d>(&result.values[0]) = solver.eigenvalues();
  Eigen::Map<Eigen::Matrix3d>(&result.vectors[0][0]) = solver.eigenvectors();
  return result;
}

std::vector<OrientedPoint> oriented_points(const PhotographSet& set) {
  const bool knows_observations =
      std::ranges::any_of(set.points, [](const auto& p) { return p.observations.size() > 1; });
  std::vector<const SparsePoint*> used;
  for (const SparsePoint& point : set.points)
    if (!knows_observations || point.observations.size() > 1) used.push_back(&point);
  const std::size_t step = used.size() / max_points + 1;
  std::vector<glm::dvec3> positions;
  std::vector<const SparsePoint*> taken;
  for (std::size_t i = 0; i < used.size(); i += step) {
    positions.push_back(used[i]->position_in_world);
    taken.push_back(used[i]);
  }
  std::vector<OrientedPoint> points(positions.size());
  parallel_for(
      positions.size(),
      [&](std::size_t i) {
        points[i] = with_normal(positions, i);
        if (glm::dot(points[i].normal, towards_cameras(*taken[i], set)) < 0.0)
          points[i].normal = -points[i].normal;
        points[i].views = std::max(int(taken[i]->observations.size()), 1);
      },
      64);
  return points;
}

double viewing_distance(const PhotographSet& set) {
  std::vector<double> distances;
  for (const SparsePoint& point : set.points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Photograph& photograph : set.photographs)
      nearest = std::min(nearest, glm::distance(photograph.position_in_world(), point.position_in_world));
    for (const Observation& o : point.observations)
      distances.push_back(glm::distance(set.photographs[std::size_t(o.photograph)].position_in_world(),
                                        point.position_in_world));
    if (point.observations.empty()) distances.push_back(nearest);
  }
  return median(std::move(distances));
}

}  // namespace parvis::photographs
