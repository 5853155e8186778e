#include "graphics/render/quality_budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"

namespace parvis::render {
namespace {

constexpr std::array<QualityLevel, 4> test_levels{{{0.02, 0.3}, {0.3, 0.6}, {0.9, 0.85}, {3.0, 1.0}}};

TEST(QualityBudget, GivesAllTheirBestWhereThereIsTime) {
  std::vector<QualityWish> wishes(5, {1.0f, test_levels});
  QualityBudget budget(100.0);
  budget.choose(wishes);
  for (const QualityWish& wish : wishes) EXPECT_EQ(wish.level, 3);
  EXPECT_DOUBLE_EQ(budget.planned_ms(), 15.0);
}

TEST(QualityBudget, GivesTheImportantMoreAndNeverTooMuch) {
  std::vector<QualityWish> wishes;
  for (int i = 0; i < 20; ++i) wishes.push_back({float(20 - i), test_levels});
  for (const double budget_ms : {0.0, 1.0, 5.0, 12.0, 40.0}) {
    QualityBudget budget(budget_ms);
    budget.choose(wishes);
    EXPECT_LE(budget.planned_ms(), std::max(budget_ms, 20 * test_levels[0].cost_ms) + 1e-9);
    EXPECT_GE(wishes.front().level, wishes.back().level);
    for (QualityWish& wish : wishes) wish.level = 0;
  }
  QualityBudget none(0.0);
  none.choose(wishes);
  for (const QualityWish& wish : wishes) EXPECT_EQ(wish.level, 0) << "what there is at least";
  none.choose({});
}

TEST(QualityBudget, WhatIsAsImportantAsAnotherKeepsItsLevel) {
  std::vector<QualityWish> wishes{{1.0f, test_levels, 0}, {1.05f, test_levels, 0}};
  QualityBudget budget(test_levels[3].cost_ms + test_levels[2].cost_ms + 0.5);
  wishes[0].level = 3;  // in the last frame
  budget.choose(wishes);
  EXPECT_EQ(wishes[0].level, 3);
  EXPECT_LT(wishes[1].level, 3);
}

/// Thirty cars pass a viewer for a minute on a machine that is slower than the model says, and that has less
/// time left when other things come into the picture.
TEST(QualityBudget, HoldsAFramesTimeOverADrive) {
  constexpr double budget_ms = 33.0;
  QualityBudget budget(budget_ms);
  Random random(4);
  std::vector<QualityWish> wishes(30, {0.0f, test_levels});
  std::vector<double> errors_percent;
  for (int frame = 0; frame < 60 * 30; ++frame) {
    const double time_s = frame / 30.0;
    for (std::size_t i = 0; i < wishes.size(); ++i) {
      const double along_m = std::fmod(10.0 * double(i) + (8.0 + double(i % 5)) * time_s, 300.0) - 150.0;
      wishes[i].importance = float(1500.0 / std::hypot(along_m, 4.0));
    }
    budget.choose(wishes);
    double chosen_ms = 0.0;
    for (const QualityWish& wish : wishes) chosen_ms += wish.levels[std::size_t(wish.level)].cost_ms;
    chosen_ms *= 1.7 * (1.0 + 0.2 * std::sin(0.3 * time_s)) * double(random.uniform(0.95f, 1.05f));
    const double rest_ms =
        (frame < 900 ? 10.0 : 14.0) + std::sin(time_s) + double(random.uniform(-0.5f, 0.5f));
    budget.frame_took(chosen_ms, rest_ms);
    if (frame > 30) errors_percent.push_back(100.0 * std::abs(chosen_ms + rest_ms - budget_ms) / budget_ms);
  }
  std::ranges::sort(errors_percent);
  EXPECT_LE(errors_percent[errors_percent.size() * 95 / 100], 10.0);
}

}  // namespace
}  // namespace parvis::render
