// Sections of lanes that vehicles cover.
#pragma once

#include <algorithm>
#include <vector>

namespace parvis::traffic {

/// The section of one lane that a vehicle covers; a long vehicle covers several lanes.
struct Presence {
  int vehicle = 0;
  float tail_m = 0.0f;   ///< start of the section, from the start of the lane
  float front_m = 0.0f;  ///< position of the front bumper; beyond the lane's end where it is on a later one
  bool holds_front = false;  ///< the front bumper is on this lane
  float speed = 0.0f;
};

/// Presences by lane: a linked list per lane, in storage that is allocated once.
class Occupancy {
 public:
  /// Creates a fixed number of lanes, all empty.
  explicit Occupancy(std::size_t lanes) : first_(lanes, none) {}

  /// Allocates storage for this many presences in all.
  void reserve(std::size_t presences) { entries_.reserve(presences); }

  /// Removes all presences; keeps the storage.
  void clear() {
    std::ranges::fill(first_, none);
    entries_.clear();
  }

  /// Adds a presence to a lane.
  void add(int lane, const Presence& presence) {
    entries_.push_back({presence, first_[std::size_t(lane)]});
    first_[std::size_t(lane)] = int(entries_.size()) - 1;
  }

  /// Calls `visit(presence)` for each presence on a lane, the last added first.
  template <class Visit>
  void for_each_on(int lane, Visit&& visit) const {
    for (int i = first_[std::size_t(lane)]; i != none; i = entries_[std::size_t(i)].next)
      visit(entries_[std::size_t(i)].presence);
  }

 private:
  static constexpr int none = -1;
  struct Entry {
    Presence presence;
    int next;
  };
  std::vector<Entry> entries_;
  std::vector<int> first_;  ///< entry of each lane
};

}  // namespace parvis::traffic
