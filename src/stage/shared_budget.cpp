#include "stage/shared_budget.h"

#include <algorithm>

namespace parvis::stage {
namespace {

constexpr double over_budget = 1.05, room_in_budget = 0.8;  // of its milliseconds
constexpr double share_step = 0.5;

}  // namespace

void SharedBudget::frame_took(double frame_ms, double budget_ms, bool is_smallest) {
  if (budget_ms <= 0.0) {
    *this = SharedBudget();
    return;
  }
  const bool is_over = is_smallest && frame_ms > over_budget * budget_ms,
             has_room = !is_smallest || frame_ms < room_in_budget * budget_ms;
  frames_over_ = is_over ? frames_over_ + 1 : 0;
  frames_with_room_ = has_room ? frames_with_room_ + 1 : 0;
  if (frames_over_ == frames_before_lowering) frames_over_ = 0, lower();
  if (frames_with_room_ == frames_before_raising) frames_with_room_ = 0, raise();
}

void SharedBudget::lower() {
  const auto next = std::ranges::find_if(shares_, [](double share) { return share > min_share; });
  if (next != shares_.end()) *next = std::max(share_step * *next, min_share);
}

void SharedBudget::raise() {
  const auto last = std::find_if(shares_.rbegin(), shares_.rend(), [](double share) { return share < 1.0; });
  if (last != shares_.rend()) *last = std::min(*last / share_step, 1.0);
}

}  // namespace parvis::stage
