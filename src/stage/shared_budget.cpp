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
  shares_[std::size_t(Lowered::pixels)] = is_smallest ? min_share : 1.0;
  const bool is_over = is_smallest && frame_ms > over_budget * budget_ms,
             has_room = !is_smallest || frame_ms < room_in_budget * budget_ms;
  frames_over_ = is_over ? frames_over_ + 1 : 0;
  frames_with_room_ = has_room ? frames_with_room_ + 1 : 0;
  if (frames_over_ == frames_before_lowering) frames_over_ = 0, lower();
  if (frames_with_room_ == frames_before_raising) frames_with_room_ = 0, raise();
}

void SharedBudget::lower() {
  for (std::size_t i = std::size_t(Lowered::reflections); i < lowered_count; ++i) {
    if (shares_[i] <= min_share) continue;
    shares_[i] = std::max(share_step * shares_[i], min_share);
    return;
  }
}

void SharedBudget::raise() {
  for (std::size_t i = lowered_count; i-- > std::size_t(Lowered::reflections);) {
    if (shares_[i] >= 1.0) continue;
    shares_[i] = std::min(shares_[i] / share_step, 1.0);
    return;
  }
}

}  // namespace parvis::stage
