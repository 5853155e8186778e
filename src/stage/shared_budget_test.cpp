#include "stage/shared_budget.h"

#include <gtest/gtest.h>

#include <vector>

namespace parvis::stage {
namespace {

constexpr double given_budget_ms = 60.0;

void take_frames(SharedBudget& budget, int frames, double frame_ms, bool is_smallest) {
  for (int i = 0; i < frames; ++i) budget.frame_took(frame_ms, given_budget_ms, is_smallest);
}

std::vector<double> shares_of(const SharedBudget& budget) {
  return {budget.share(Lowered::reflections), budget.share(Lowered::people), budget.share(Lowered::sound)};
}

TEST(SharedBudget, NothingIsLoweredWhileFewerPixelsCanBeDrawn) {
  SharedBudget budget;
  take_frames(budget, 200, 4.0 * given_budget_ms, false);
  EXPECT_EQ(shares_of(budget), (std::vector{1.0, 1.0, 1.0}));
}

TEST(SharedBudget, ReflectionsGoFirstThenPeopleThenSound) {
  SharedBudget budget;
  std::vector<std::vector<double>> seen{shares_of(budget)};
  for (int frame = 0; frame < 200; ++frame) {
    take_frames(budget, 1, 2.0 * given_budget_ms, true);
    if (shares_of(budget) != seen.back()) seen.push_back(shares_of(budget));
  }
  const std::vector<std::vector<double>> expected{{1.0, 1.0, 1.0},   {0.5, 1.0, 1.0},   {0.25, 1.0, 1.0},
                                                  {0.25, 0.5, 1.0},  {0.25, 0.25, 1.0}, {0.25, 0.25, 0.5},
                                                  {0.25, 0.25, 0.25}};
  EXPECT_EQ(seen, expected);
}

TEST(SharedBudget, WhatWasLoweredLastIsRaisedFirst) {
  SharedBudget budget;
  take_frames(budget, 5 * SharedBudget::frames_before_lowering, 2.0 * given_budget_ms, true);
  ASSERT_EQ(shares_of(budget), (std::vector{0.25, 0.25, 0.5}));
  take_frames(budget, SharedBudget::frames_before_raising, 0.5 * given_budget_ms, true);
  EXPECT_EQ(shares_of(budget), (std::vector{0.25, 0.25, 1.0}));
  take_frames(budget, SharedBudget::frames_before_raising, 0.9 * given_budget_ms, false);
  EXPECT_EQ(shares_of(budget), (std::vector{0.25, 0.5, 1.0}));
  take_frames(budget, 10 * SharedBudget::frames_before_raising, 0.5 * given_budget_ms, true);
  EXPECT_EQ(shares_of(budget), (std::vector{1.0, 1.0, 1.0}));
}

TEST(SharedBudget, SingleLongFramesChangeNothing) {
  SharedBudget budget;
  for (int i = 0; i < 40; ++i) {
    take_frames(budget, SharedBudget::frames_before_lowering - 1, 5.0 * given_budget_ms, true);
    take_frames(budget, 1, 0.95 * given_budget_ms, true);
  }
  EXPECT_EQ(shares_of(budget), (std::vector{1.0, 1.0, 1.0}));
}

TEST(SharedBudget, WithoutABudgetAllIsWhole) {
  SharedBudget budget;
  take_frames(budget, 100, 2.0 * given_budget_ms, true);
  budget.frame_took(500.0, 0.0, true);
  EXPECT_EQ(shares_of(budget), (std::vector{1.0, 1.0, 1.0}));
}

}  // namespace
}  // namespace parvis::stage
