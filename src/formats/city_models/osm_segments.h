// Straight pieces of the ways of OpenStreetMap by cells of the plan, so that those near a place are found
// without looking at all of a country's.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <unordered_map>
#include <vector>

namespace parvis::scene {

/// Segments with what each belongs to (`Owner`, small and comparable).
template <class Owner>
class OsmSegments {
 public:
  struct Segment {
    glm::dvec2 a, b;
    Owner owner;
  };

  void add(glm::dvec2 a, glm::dvec2 b, Owner owner) {
    const auto index = std::uint32_t(segments_.size());
    segments_.push_back({a, b, owner});
    each_step(a, b, [&](glm::ivec2 cell) {
      std::vector<std::uint32_t>& here = cells_[key(cell)];
      if (here.empty() || here.back() != index) here.push_back(index);
    });
  }

  /// Calls use(segment) for all that may cross the segment from a to b, some of them several times; false
  /// ends it. Where a map heaps more segments on one place than streets can have, only the first of them are
  /// looked at, so that the work grows with the map alone.
  template <class Use>
  void each_near(glm::dvec2 a, glm::dvec2 b, const Use& use) const {
    bool continues = true;
    each_step(a, b, [&](glm::ivec2 middle) {
      int left = max_near;
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          const auto cell = cells_.find(key(middle + glm::ivec2(x, y)));
          if (cell == cells_.end()) continue;
          for (const std::uint32_t index : cell->second)
            if (continues && left > 0) continues = use(segments_[index]), --left;
        }
    });
  }

 private:
  static constexpr double cell_m = 40.0;
  static constexpr int max_near = 5000;  // around a cell: the densest towns have some hundreds

  /// The cells of points at most half a cell apart: what crosses a segment has a point in a cell beside one.
  template <class Use>
  static void each_step(glm::dvec2 a, glm::dvec2 b, const Use& use) {
    const int steps = std::max(1, int(glm::distance(a, b) / (0.5 * cell_m)) + 1);
    glm::ivec2 last(0);
    for (int i = 0; i <= steps; ++i) {
      const glm::ivec2 cell(glm::floor(glm::mix(a, b, double(i) / double(steps)) / cell_m));
      if (i == 0 || cell != last) use(cell);
      last = cell;
    }
  }
  static std::uint64_t key(glm::ivec2 cell) {
    return std::uint64_t(std::uint32_t(cell.x)) << 32u | std::uint32_t(cell.y);
  }

  std::vector<Segment> segments_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace parvis::scene
