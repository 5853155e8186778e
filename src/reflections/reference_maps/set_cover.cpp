#include "reflections/reference_maps/set_cover.h"

#include <algorithm>

namespace parvis::reference_maps {

/// Which sets are chosen, and for every set how many elements it would add now.
class SetCover::State {
 public:
  explicit State(const SetCover& cover) : cover_(cover), times_(cover.holders_.size()) {
    for (const Elements& set : cover.sets_) adds_.push_back(set.size());
  }

  const Chosen& chosen() const { return chosen_; }
  std::size_t covered() const { return covered_; }

  void put(std::size_t slot, std::size_t set) {
    chosen_.insert(chosen_.begin() + std::ptrdiff_t(slot), set);
    for (const std::uint32_t element : cover_.sets_[set]) {
      if (times_[element]++ > 0) continue;
      ++covered_;
      for (const std::uint32_t holder : cover_.holders_[element]) --adds_[holder];
    }
  }

  void take(std::size_t slot) {
    const std::size_t set = chosen_[slot];
    chosen_.erase(chosen_.begin() + std::ptrdiff_t(slot));
    for (const std::uint32_t element : cover_.sets_[set]) {
      if (--times_[element] > 0) continue;
      --covered_;
      for (const std::uint32_t holder : cover_.holders_[element]) ++adds_[holder];
    }
  }

  /// The set that adds the most to those chosen and goes with them; `otherwise` if none adds more.
  std::size_t best(std::size_t otherwise) const {
    std::size_t best = otherwise;
    for (std::size_t set = 0; set < adds_.size(); ++set)
      if (adds_[set] > (best < adds_.size() ? adds_[best] : 0) &&
          std::ranges::all_of(chosen_, [&](std::size_t other) { return cover_.go_together_(set, other); }))
        best = set;
    return best;
  }

  /// The chosen set that alone covers the fewest elements.
  std::size_t min_slot() const {
    const auto alone = [&](std::size_t set) {
      return std::ranges::count_if(cover_.sets_[set],
                                   [&](std::uint32_t element) { return times_[element] == 1; });
    };
    return std::size_t(std::ranges::min_element(chosen_, {}, alone) - chosen_.begin());
  }

  /// Puts another set in the place of one wherever that covers more, until none does.
  void exchange() {
    for (bool has_gained = true; has_gained;) {
      has_gained = false;
      for (std::size_t slot = 0; slot < chosen_.size(); ++slot) {
        const std::size_t before = chosen_[slot];
        take(slot);
        const std::size_t after = best(before);
        put(slot, after);
        has_gained |= after != before;
      }
    }
  }

 private:
  const SetCover& cover_;
  Chosen chosen_;
  std::vector<std::uint32_t> times_;  ///< of each element: how many chosen sets hold it
  std::vector<std::size_t> adds_;     ///< of each set
  std::size_t covered_ = 0;
};

SetCover::SetCover(std::vector<Elements> sets, std::size_t element_count,
                   std::function<bool(std::size_t, std::size_t)> go_together)
    : sets_(std::move(sets)), holders_(element_count), go_together_(std::move(go_together)) {
  for (std::size_t set = 0; set < sets_.size(); ++set)
    for (const std::uint32_t element : sets_[set]) holders_[element].push_back(std::uint32_t(set));
}

SetCover::Chosen SetCover::greedy(std::size_t maximum, std::size_t enough) const {
  State state(*this);
  while (state.chosen().size() < maximum && state.covered() < enough) {
    const std::size_t best = state.best(sets_.size());
    if (best == sets_.size()) break;
    state.put(state.chosen().size(), best);
  }
  return state.chosen();
}

SetCover::Chosen SetCover::improved(const Chosen& start, std::size_t enough) const {
  State state(*this);
  for (const std::size_t set : start) state.put(state.chosen().size(), set);
  state.exchange();
  Chosen best = state.chosen();
  while (!state.chosen().empty() && state.covered() >= enough) {
    best = state.chosen();
    state.take(state.min_slot());
    state.exchange();
  }
  return best;
}

}  // namespace parvis::reference_maps
