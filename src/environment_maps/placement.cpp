#include "environment_maps/placement.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "scene/path.h"

namespace parvis::environment_maps {
namespace {

constexpr float height_m = 1.2f;  // of a map over the street: that of bodywork
constexpr float candidates_apart_m = 4.0f;
constexpr float beyond_area_m = 60.0f;  // traffic drives on to the next crossing

std::vector<glm::vec3> street_candidates(const scene::Scene& scene) {
  std::vector<glm::vec3> candidates;
  for (const scene::Lane& lane : scene.roads.lanes) {
    const scene::MeasuredPath path(lane.points);
    const int count = int(path.length() / candidates_apart_m) + 1;
    for (int i = 0; i < count; ++i) {
      const glm::vec3 at = path.at(float(i) * candidates_apart_m);
      const float off_area_m = glm::distance(glm::vec2(at), scene.traffic.centre) - scene.traffic.radius_m;
      if (off_area_m < beyond_area_m) candidates.push_back(at + glm::vec3(0, 0, height_m));
    }
  }
  return candidates;
}

/// Middles of squares of the ground that nothing stands on.
std::vector<glm::vec3> open_candidates(const HeightPyramid& heights) {
  std::vector<glm::vec3> candidates;
  if (heights.levels().empty()) return {glm::vec3(0, 0, height_m)};
  const ImageF& field = heights.levels().front();
  const int step = std::max(1, std::max(heights.cells().x, heights.cells().y) / 64);
  std::vector<float> all;
  for (int y = 0; y < heights.cells().y; y += step)
    for (int x = 0; x < heights.cells().x; x += step) all.push_back(*field.at(x, y));
  std::ranges::nth_element(all, all.begin() + std::ptrdiff_t(all.size() / 4));
  const float ground_m = all[all.size() / 4];
  for (int y = 0; y < heights.cells().y; y += step)
    for (int x = 0; x < heights.cells().x; x += step)
      if (*field.at(x, y) < ground_m + height_m)
        candidates.emplace_back(heights.origin() + heights.cell_m() * (glm::vec2(x, y) + 0.5f),
                                *field.at(x, y) + height_m);
  return candidates;
}

}  // namespace

std::vector<glm::vec3> spread_places(const scene::Scene& scene, const HeightPyramid& heights, int most) {
  std::vector<glm::vec3> candidates = street_candidates(scene);
  if (candidates.empty()) candidates = open_candidates(heights);
  if (candidates.empty()) return {};

  std::vector<glm::vec3> places;
  std::vector<float> distances(candidates.size(), std::numeric_limits<float>::max());
  const glm::vec3 middle =
      std::accumulate(candidates.begin(), candidates.end(), glm::vec3(0.0f)) / float(candidates.size());
  std::size_t next = std::size_t(
      std::ranges::min_element(candidates, {}, [&](glm::vec3 p) { return glm::distance(p, middle); }) -
      candidates.begin());
  while (int(places.size()) < most && (places.empty() || distances[next] >= least_apart_m)) {
    places.push_back(candidates[next]);
    for (std::size_t i = 0; i < candidates.size(); ++i)
      distances[i] = std::min(distances[i], glm::distance(candidates[i], places.back()));
    next = std::size_t(std::ranges::max_element(distances) - distances.begin());
  }
  return places;
}

}  // namespace parvis::environment_maps
