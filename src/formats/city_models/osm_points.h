// Points of the plan by cells, so that those in a box are found without looking at all of a country's.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <unordered_map>
#include <vector>

namespace parvis::scene {

/// Points with what each belongs to (`Owner`, small).
template <class Owner>
class OsmPoints {
 public:
  void add(glm::dvec2 point, Owner owner) { cells_[key(cell_of(point))].push_back({point, owner}); }

  /// Calls use(point, owner) for the points in a box, cell by cell. A box of more than `max_cells` has none,
  /// and no more than `max_seen` are looked at and `max_used` used: no building is as large and no place as
  /// crowded, and so the work grows with the map alone.
  template <class Use>
  void each_in(glm::dvec2 low, glm::dvec2 high, const Use& use) const {
    const glm::i64vec2 first = cell_of(low), last = cell_of(high);
    if ((last.x - first.x + 1) * (last.y - first.y + 1) > max_cells) return;
    int unseen = max_seen, unused = max_used;
    for (std::int64_t y = first.y; y <= last.y; ++y)
      for (std::int64_t x = first.x; x <= last.x; ++x) {
        const auto cell = cells_.find(key({x, y}));
        if (cell == cells_.end()) continue;
        for (const Entry& entry : cell->second) {
          if (--unseen < 0) return;
          const bool is_inside = glm::all(glm::greaterThanEqual(entry.point, low)) &&
                                 glm::all(glm::lessThanEqual(entry.point, high));
          if (!is_inside) continue;
          if (--unused < 0) return;
          use(entry.point, entry.owner);
        }
      }
  }

 private:
  static constexpr double cell_m = 100.0;
  static constexpr std::int64_t max_cells = 900;
  static constexpr int max_seen = 10'000, max_used = 1000;

  struct Entry {
    glm::dvec2 point;
    Owner owner;
  };
  static glm::i64vec2 cell_of(glm::dvec2 point) { return glm::i64vec2(glm::floor(point / cell_m)); }
  static std::uint64_t key(glm::i64vec2 cell) {
    return std::uint64_t(std::uint32_t(cell.x)) << 32u | std::uint32_t(cell.y);
  }

  std::unordered_map<std::uint64_t, std::vector<Entry>> cells_;
};

}  // namespace parvis::scene
