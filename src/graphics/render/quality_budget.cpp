#include "graphics/render/quality_budget.h"

#include <algorithm>

namespace parvis::render {
namespace {

constexpr double stays = 1.3;  // what a level that a thing has is worth more than one that it would get
constexpr double frame_weight = 0.25;  // share of a frame in what is known of the clock: a few frames' memory
constexpr double min_share_ms = 0.01;  // a model that says less cannot be held against the clock
constexpr double min_scale = 1e-3, max_scale = 1e3;

}  // namespace

void QualityBudget::choose(std::span<QualityWish> wishes) {
  steps_.clear();
  planned_cost_ms_ = 0.0;
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    const QualityWish& wish = wishes[i];
    planned_cost_ms_ += wish.levels.front().cost_ms;
    for (std::size_t level = 1; level < wish.levels.size(); ++level) {
      const double cost_ms = wish.levels[level].cost_ms - wish.levels[level - 1].cost_ms;
      const double worth = wish.levels[level].worth - wish.levels[level - 1].worth;
      const double kept = int(level) <= wish.level ? stays : 1.0;
      steps_.push_back(
          {kept * double(wish.importance) * worth / std::max(cost_ms, 1e-9), int(i), int(level)});
    }
  }
  for (QualityWish& wish : wishes) wish.level = 0;
  std::ranges::sort(steps_, [](const Step& a, const Step& b) {
    return a.worth_per_ms != b.worth_per_ms ? a.worth_per_ms > b.worth_per_ms
                                            : std::pair(a.wish, a.level) < std::pair(b.wish, b.level);
  });
  const double affordable_ms = (budget_ms_ - rest_ms_) / scale_;
  for (const Step& step : steps_) {
    QualityWish& wish = wishes[std::size_t(step.wish)];
    const auto level = std::size_t(step.level);
    const double cost_ms = wish.levels[level].cost_ms - wish.levels[level - 1].cost_ms;
    if (wish.level != step.level - 1 || planned_cost_ms_ + cost_ms > affordable_ms) continue;
    wish.level = step.level;
    planned_cost_ms_ += cost_ms;
  }
}

void QualityBudget::frame_took(double chosen_ms, double rest_ms) {
  rest_ms_ += (rest_ms_ == 0.0 ? 1.0 : frame_weight) * (rest_ms - rest_ms_);
  if (planned_cost_ms_ < min_share_ms) return;
  const double scale = std::clamp(chosen_ms / planned_cost_ms_, min_scale, max_scale);
  scale_ += frame_weight * (scale - scale_);
}

}  // namespace parvis::render
