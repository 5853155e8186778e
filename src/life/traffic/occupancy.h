// Who is where: the parts of lanes that vehicles' bodies cover.
#pragma once

#include <algorithm>
#include <vector>

namespace parvis::traffic {

/// A vehicle's body on one lane. A long body lies on several.
struct Presence {
  int vehicle = 0;
  float tail_m = 0.0f;       ///< where the covered part begins
  float front_m = 0.0f;      ///< of the front bumper, where it is on this lane
  bool holds_front = false;  ///< else the front bumper is on a later lane
  float speed = 0.0f;
};

/// Presences by lane, in storage that is set aside once.
class Occupancy {
 public:
  explicit Occupancy(std::size_t lanes) : first_(lanes, none) {}

  void reserve(std::size_t presences) { entries_.reserve(presences); }

  void clear() {
    std::ranges::fill(first_, none);
    entries_.clear();
  }

  void add(int lane, const Presence& presence) {
    entries_.push_back({presence, first_[std::size_t(lane)]});
    first_[std::size_t(lane)] = int(entries_.size()) - 1;
  }

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
