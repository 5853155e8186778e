#include "formats/city_models/gables.h"

#include <cmath>
#include <optional>
#include <set>

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;

constexpr double steepest_ridge = 0.35;  // of the roof's own slope; the line of a square hip rises by 0.7
constexpr double nearest_corner = 0.1;   // of the edge's length, from the top of the gable

/// Neighbours of each point: those that it shares an edge of a face with.
std::vector<std::set<int>> neighbours_of(const StraightSkeleton& skeleton) {
  std::vector<std::set<int>> neighbours(skeleton.points.size());
  for (const std::vector<int>& face : skeleton.faces)
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int a = face[i], b = face[(i + 1) % face.size()];
      neighbours[std::size_t(a)].insert(b), neighbours[std::size_t(b)].insert(a);
    }
  return neighbours;
}

/// Where the ridge from `far` to `tip` meets the edge a b, at its own slope.
std::optional<dvec3> top_of_gable(const dvec3& a, const dvec3& b, const dvec3& tip, const dvec3& far) {
  const dvec3 ridge = tip - far;
  const double length_m = glm::length(dvec2(ridge));
  if (far.z <= 0.0 || std::abs(ridge.z) > steepest_ridge * length_m) return std::nullopt;
  const dvec2 edge(b - a), from(tip - a);
  const double across = cross_in_plan(dvec2(ridge), edge);
  if (across == 0.0) return std::nullopt;
  const double extended = cross_in_plan(edge, from) / across,
               along = cross_in_plan(dvec2(ridge), from) / across;
  if (!(extended > 0.0) || along < nearest_corner || along > 1.0 - nearest_corner) return std::nullopt;
  const dvec2 place = dvec2(a) + along * edge;
  return dvec3(place, tip.z + extended * ridge.z);
}

}  // namespace

std::vector<bool> raise_gables(StraightSkeleton& skeleton) {
  const std::vector<std::set<int>> neighbours = neighbours_of(skeleton);
  std::vector<bool> is_gable(skeleton.faces.size(), false);
  std::set<int> moved;
  for (std::size_t i = 0; i < skeleton.faces.size(); ++i) {
    const std::vector<int>& face = skeleton.faces[i];
    if (face.size() != 3) continue;
    const std::set<int>& around = neighbours[std::size_t(face[2])];
    if (around.size() != 3 || moved.contains(face[2])) continue;
    int far = face[0];
    for (const int point : around)
      if (point != face[0] && point != face[1]) far = point;
    const auto at = [&](int point) { return skeleton.points[std::size_t(point)]; };
    const std::optional<dvec3> top = top_of_gable(at(face[0]), at(face[1]), at(face[2]), at(far));
    if (!top) continue;
    skeleton.points[std::size_t(face[2])] = *top;
    moved.insert(face[2]);
    is_gable[i] = true;
  }
  return is_gable;
}

}  // namespace parvis::scene
