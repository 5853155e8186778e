#include "life/traffic/right_of_way.h"

#include <algorithm>

namespace parvis::traffic {

namespace {
constexpr float patience_s = 3.0f;
}

bool RightOfWay::is_free(int lane, std::span<const int> held) const {
  if (barred_[std::size_t(lane)] == round_) return false;
  return std::ranges::none_of(lanes_[std::size_t(lane)].conflicts, [&](int other) {
    return holders_[std::size_t(other)] > std::ranges::count(held, other);
  });
}

bool RightOfWay::request(std::span<const int> wanted, std::span<const int> held, float waited_s) {
  if (std::ranges::all_of(wanted, [&](int lane) { return is_free(lane, held); })) {
    for (const int lane : wanted) ++holders_[std::size_t(lane)];
    return true;
  }
  if (waited_s > patience_s)
    for (const int lane : wanted)
      for (const int other : lanes_[std::size_t(lane)].conflicts) barred_[std::size_t(other)] = round_;
  return false;
}

}  // namespace parvis::traffic
