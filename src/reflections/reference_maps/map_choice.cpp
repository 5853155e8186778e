#include "reflections/reference_maps/map_choice.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/parallel.h"

namespace parvis::reference_maps {
namespace {

constexpr int max_cells = 512;          // a side
constexpr std::size_t looked_at = 12;   // nearest maps of a cell, of which the best are kept
constexpr float unseen_penalty = 5.0f;  // a map behind a house counts as so many times farther away

}  // namespace

MapChoice::MapChoice(const std::vector<glm::vec3>& places, const HeightPyramid& heights)
    : origin_(heights.origin()) {
  const glm::vec2 size = heights.cell_m() * glm::vec2(heights.cells());
  cell_m_ = std::max(cell_m_, std::max(size.x, size.y) / float(max_cells));
  cells_ = glm::max(glm::ivec2(glm::ceil(size / cell_m_)), glm::ivec2(1));
  indices_.resize(std::size_t(cells_.x) * std::size_t(cells_.y) * maps_per_cell);
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
        const glm::vec3 to_middle = glm::vec3(middle, place.z) - place;
        const float distance = glm::length(to_middle);
        const bool is_seen =
            distance < 1e-3f ||
            heights.walk_by_levels(place, to_middle / distance, distance).kind == HitKind::nothing;
        ranked[i] = {distance * (is_seen ? 1.0f : unseen_penalty), nearest[i]};
      }
      std::sort(ranked.begin(), ranked.begin() + std::ptrdiff_t(kept));
      std::uint16_t* cell = &indices_[(y * std::size_t(cells_.x) + std::size_t(x)) * maps_per_cell];
      for (std::size_t k = 0; k < maps_per_cell; ++k)
        cell[k] = std::uint16_t(ranked[std::min(k, kept - 1)].second);
    }
  });
}

}  // namespace parvis::reference_maps
