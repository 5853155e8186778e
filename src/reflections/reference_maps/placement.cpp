#include "reflections/reference_maps/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "base/parallel.h"
#include "reflections/reference_maps/driving_area.h"
#include "reflections/reference_maps/set_cover.h"

namespace parvis::reference_maps {
namespace {

constexpr float map_height_m = 1.2f;        // of a map over the street: that of bodywork
constexpr float candidates_apart_m = 4.0f;  // along a lane
constexpr float alike_m = 2.0f;             // lanes cross and run side by side: one candidate is enough
constexpr std::size_t candidates_per_map = 16, min_candidates = 1024;
constexpr std::size_t points_per_map = 160;  // fewer, and chance decides what a map is worth
constexpr std::size_t min_points = 8192, max_points = 65536;
// Other points are shown a little less well than those that choose, so that these must reach more.
constexpr int attempts = 9;
constexpr float attempt_step = 0.001f;
constexpr float shown_in_pictures = 0.995f;           // the rest takes as many maps again
constexpr std::uint64_t judging_seed = 0x6a75646765;  // of points that the choice does not see

/// One place of each cube of `side_m` that has any.
std::vector<glm::vec3> thinned(const std::vector<glm::vec3>& places, float side_m) {
  std::vector<glm::vec3> kept;
  std::set<std::array<int, 3>> taken;
  std::ranges::copy_if(places, std::back_inserter(kept), [&](glm::vec3 place) {
    const glm::ivec3 cube(glm::round(place / side_m));
    return taken.insert({cube.x, cube.y, cube.z}).second;
  });
  return kept;
}

std::vector<glm::vec3> candidate_places(const scene::Scene& scene, const HeightPyramid& heights,
                                        std::size_t max_maps) {
  std::vector<glm::vec3> candidates = driving_places(scene, heights, candidates_apart_m);
  const std::size_t enough = std::max(candidates_per_map * max_maps, min_candidates);
  float side_m = alike_m;
  candidates = thinned(candidates, side_m);
  while (candidates.size() > enough) candidates = thinned(candidates, side_m *= 1.25f);
  for (glm::vec3& candidate : candidates) candidate.z += map_height_m;
  return candidates;
}

/// The points that each place shows; a point counts once for each sharpness.
std::vector<SetCover::Elements> shown_from(const std::vector<glm::vec3>& places, const HeightPyramid& heights,
                                           const std::vector<MirroredPoint>& points,
                                           const std::vector<float>& sharpness) {
  std::vector<SetCover::Elements> shown(places.size());
  const float min_sharp = *std::ranges::max_element(sharpness);
  parallel_for(places.size(), [&](std::size_t place) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!shows(heights, places[place], points[i], min_sharp)) continue;
      const float times = footprint(places[place], points[i]) / points[i].vehicle_footprint;
      for (std::size_t k = 0; k < sharpness.size(); ++k)
        if (times <= sharpness[k]) shown[place].push_back(std::uint32_t(k * points.size() + i));
    }
  });
  return shown;
}

/// Indices of an even spread: each next one farthest from all before it.
std::vector<std::size_t> even_spread(const std::vector<glm::vec3>& candidates, std::size_t maximum) {
  std::vector<std::size_t> spread;
  std::vector<float> distances(candidates.size(), std::numeric_limits<float>::max());
  const glm::vec3 middle =
      std::accumulate(candidates.begin(), candidates.end(), glm::vec3(0.0f)) / float(candidates.size());
  std::size_t next = std::size_t(
      std::ranges::min_element(candidates, {}, [&](glm::vec3 p) { return glm::distance(p, middle); }) -
      candidates.begin());
  while (spread.size() < maximum && (spread.empty() || distances[next] >= min_apart_m)) {
    spread.push_back(next);
    for (std::size_t i = 0; i < candidates.size(); ++i)
      distances[i] = std::min(distances[i], glm::distance(candidates[i], candidates[next]));
    next = std::size_t(std::ranges::max_element(distances) - distances.begin());
  }
  return spread;
}

std::vector<glm::vec3> picked(const std::vector<glm::vec3>& candidates,
                              const std::vector<std::size_t>& chosen) {
  std::vector<glm::vec3> places;
  places.reserve(chosen.size());
  for (const std::size_t candidate : chosen) places.push_back(candidates[candidate]);
  return places;
}

}  // namespace

Placement place_by_coverage(const scene::Scene& scene, const HeightPyramid& heights,
                            const PlacementGoal& goal) {
  const std::size_t maximum = std::size_t(std::max(goal.max_maps, 0));
  const std::vector<glm::vec3> candidates = candidate_places(scene, heights, maximum);
  const std::size_t count = std::clamp(points_per_map * maximum, min_points, max_points);
  const std::vector<MirroredPoint> points = mirrored_points(scene, heights, count, goal.seed);
  const std::size_t elements = points.size() * goal.sharpness.size();
  const SetCover cover(shown_from(candidates, heights, points, goal.sharpness), elements,
                       [&](std::size_t a, std::size_t b) {
                         return glm::distance(candidates[a], candidates[b]) >= min_apart_m;
                       });
  const std::vector<MirroredPoint> judges =
      mirrored_points(scene, heights, max_points, goal.seed ^ judging_seed);

  Placement placement;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const float share = goal.share_shown + float(attempt) * attempt_step;
    const std::size_t enough = std::size_t(std::ceil(share * float(elements)));
    const std::vector<std::size_t> chosen = cover.improved(cover.greedy(maximum, enough), enough);
    placement.places = picked(candidates, chosen);
    const std::vector<float> shares = coverage(heights, placement.places, judges, goal.sharpness.back());
    placement.share_shown = shares.empty() ? 0.0f : shares.back();
    if (placement.share_shown >= goal.share_shown || chosen.size() >= maximum || enough > elements) break;
  }
  return placement;
}

Placement place_for_pictures(const scene::Scene& scene, const HeightPyramid& heights, int maximum) {
  return place_by_coverage(scene, heights, {maximum, shown_in_pictures, {8.0f, 4.0f}});
}

std::vector<glm::vec3> spread_places(const scene::Scene& scene, const HeightPyramid& heights, int maximum) {
  const std::size_t count = std::size_t(std::max(maximum, 0));
  const std::vector<glm::vec3> candidates = candidate_places(scene, heights, count);
  return picked(candidates, even_spread(candidates, count));
}

std::vector<glm::vec3> spread_over_roads(const scene::Scene& scene, const HeightPyramid& heights,
                                         int maximum) {
  scene::Scene everywhere;
  everywhere.roads = scene.roads;
  return spread_places(everywhere, heights, maximum);
}

}  // namespace parvis::reference_maps
