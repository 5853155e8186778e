#include "environment_maps/placement.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "scene/path.h"

namespace parvis::environment_maps {
namespace {

constexpr float height_m = 1.2f;  // of a map over the street: that of bodywork
constexpr float candidates_apart_m = 4.0f;
constexpr float beyond_area_m = 60.0f;  // traffic drives on to the next crossing
constexpr int most_choice_cells = 512;  // a side
constexpr std::size_t looked_at = 12;   // nearest maps of a cell, of which the best are kept
constexpr float unseen_penalty = 5.0f;  // a map behind a house counts as so many times farther away

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

MapChoice::MapChoice(const std::vector<glm::vec3>& places, const HeightPyramid& heights)
    : origin_(heights.origin()) {
  const glm::vec2 size = heights.cell_m() * glm::vec2(heights.cells());
  cell_m_ = std::max(cell_m_, std::max(size.x, size.y) / float(most_choice_cells));
  cells_ = glm::max(glm::ivec2(glm::ceil(size / cell_m_)), glm::ivec2(1));
  indices_.resize(std::size_t(cells_.x) * std::size_t(cells_.y) * maps_a_cell);
  const std::size_t kept = std::min(places.size(), looked_at);
  parallel_for(std::size_t(cells_.y), [&](std::size_t y) {
    std::vector<int> nearest(places.size());
    for (int x = 0; x < cells_.x; ++x) {
      const glm::vec2 middle = origin_ + cell_m_ * (glm::vec2(x, int(y)) + 0.5f);
      const auto plan_distance = [&](int i) {
        return glm::distance(glm::vec2(places[std::size_t(i)]), middle);
      };
      std::iota(nearest.begin(), nearest.end(), 0);
      std::ranges::partial_sort(nearest, nearest.begin() + std::ptrdiff_t(kept), {}, plan_distance);

      std::array<std::pair<float, int>, looked_at> ranked;
      for (std::size_t i = 0; i < kept; ++i) {
        const glm::vec3 place = places[std::size_t(nearest[i])];
        const glm::vec3 way = glm::vec3(middle, place.z) - place;
        const float distance = glm::length(way);
        const bool is_seen =
            distance < 1e-3f || heights.walk_by_levels(place, way / distance, distance).met == Met::nothing;
        ranked[i] = {distance * (is_seen ? 1.0f : unseen_penalty), nearest[i]};
      }
      std::sort(ranked.begin(), ranked.begin() + std::ptrdiff_t(kept));
      std::uint16_t* cell = &indices_[(y * std::size_t(cells_.x) + std::size_t(x)) * maps_a_cell];
      for (std::size_t k = 0; k < maps_a_cell; ++k)
        cell[k] = std::uint16_t(ranked[std::min(k, kept - 1)].second);
    }
  });
}

}  // namespace parvis::environment_maps
