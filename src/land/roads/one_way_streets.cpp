#include "land/roads/one_way_streets.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

namespace parvis::scene {
namespace {

/// Which roads lead to which places, and the roads as they are now.
class StreetPlan {
 public:
  explicit StreetPlan(const std::vector<Road>& roads) : roads_(roads) {
    ends_.reserve(roads.size());
    for (std::size_t road = 0; road < roads.size(); ++road) {
      ends_.push_back({place_of(roads[road].path.front()), place_of(roads[road].path.back())});
      for (const std::size_t end : ends_.back()) roads_at_[end].push_back(road);
    }
    seen_.resize(roads_at_.size());
  }

  /// Whether one gets from the end of `street` to its start without it.
  bool has_way_round(std::size_t street) { return has_way(street, ends_[street][1], ends_[street][0]); }
  /// Whether one gets from the start of `street` to its end without it.
  bool has_way_along(std::size_t street) { return has_way(street, ends_[street][0], ends_[street][1]); }
  /// The road goes the other way from now on.
  void reverse(std::size_t road) { std::swap(ends_[road][0], ends_[road][1]); }

 private:
  /// When a search came by: forward and backward.
  using Seen = std::array<std::size_t, 2>;

  std::size_t place_of(glm::vec3 position) {
    const auto [entry, is_new] =
        places_.try_emplace(std::tuple(position.x, position.y, position.z), roads_at_.size());
    if (is_new) roads_at_.emplace_back();
    return entry->second;
  }

  /// Searches from both sides, a place of each in turn: a dead end is found out as soon as the smaller side
  /// is searched.
  bool has_way(std::size_t without, std::size_t from, std::size_t to) {
    if (from == to) return true;
    ++search_;
    std::array<std::vector<std::size_t>, 2> reached{{{from}, {to}}};
    seen_[from][0] = seen_[to][1] = search_;
    for (std::size_t i = 0; i < std::min(reached[0].size(), reached[1].size()); ++i)
      for (const std::size_t side : {std::size_t(0), std::size_t(1)}) {
        const std::size_t here = reached[side][i];
        for (const std::size_t road : roads_at_[here]) {
          if (road == without) continue;
          const bool is_open = ends_[road][side] == here || !roads_[road].is_one_way;
          const std::size_t there = ends_[road][0] == here ? ends_[road][1] : ends_[road][0];
          if (!is_open || seen_[there][side] == search_) continue;
          if (seen_[there][1 - side] == search_) return true;
          seen_[there][side] = search_;
          reached[side].push_back(there);
        }
      }
    return false;
  }

  const std::vector<Road>& roads_;
  std::map<std::tuple<float, float, float>, std::size_t> places_;
  std::vector<std::array<std::size_t, 2>> ends_;    ///< of each road, its first place and its last
  std::vector<std::vector<std::size_t>> roads_at_;  ///< of each place
  std::vector<Seen> seen_;                          ///< of each place
  std::size_t search_ = 0;
};

}  // namespace

void make_narrow_streets_one_way(std::vector<Road>& roads, float narrowest_lane_m) {
  StreetPlan plan(roads);
  for (std::size_t i = 0; i < roads.size(); ++i) {
    Road& road = roads[i];
    if (road.is_one_way || road.lanes_each_way > 1 || road.lanes_back > 1 ||
        road.lane_width_m >= narrowest_lane_m)
      continue;
    road.is_one_way = plan.has_way_round(i);
    if (!road.is_one_way && plan.has_way_along(i)) {
      std::ranges::reverse(road.path);
      plan.reverse(i);
      road.is_one_way = true;
    }
    if (road.is_one_way) road.lane_width_m *= 2.0f;
    road.lane_width_m = std::max(road.lane_width_m, narrowest_lane_m);
  }
}

}  // namespace parvis::scene
