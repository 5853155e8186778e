#include "planning/planner/snap.h"

#include <gtest/gtest.h>

namespace parvis::planner {
namespace {

void expect_at(const Snapped& snapped, glm::dvec2 at, SnapKind kind) {
  EXPECT_NEAR(snapped.at.x, at.x, 1e-9);
  EXPECT_NEAR(snapped.at.y, at.y, 1e-9);
  EXPECT_EQ(snapped.kind, kind) << name_of(snapped.kind);
}

TEST(Snap, TakesTheStrongestThatIsNear) {
  SnapTargets targets;
  targets.lines = {{{{0, 0}, {10, 0}}}, {{{4, -5}, {4, 5}}}};
  targets.ends = {{10, 0}};
  targets.grid_m = 0.5;
  expect_at(snap({9.9, 0.1}, targets, 0.3), {10, 0}, SnapKind::end);
  expect_at(snap({4.1, 0.1}, targets, 0.3), {4, 0}, SnapKind::crossing);
  expect_at(snap({7.0, 0.2}, targets, 0.3), {7, 0}, SnapKind::line);
  expect_at(snap({7.1, 2.2}, targets, 0.3), {7, 2}, SnapKind::grid);
  targets.grid_m = 0.0;
  expect_at(snap({7.1, 2.2}, targets, 0.3), {7.1, 2.2}, SnapKind::none);
}

TEST(Snap, ContinuesARowAndFindsItsMiddle) {
  SnapTargets targets;
  targets.middles = {{0, 0}, {2, 1}};
  const Snapped next = snap({4.1, 1.9}, targets, 0.3);
  expect_at(next, {4, 2}, SnapKind::spacing);
  EXPECT_EQ(next.guides.size(), 2u) << "two equal steps are drawn";
  expect_at(snap({1.1, 0.5}, targets, 0.3), {1, 0.5}, SnapKind::spacing);
  expect_at(snap({-2.1, -0.9}, targets, 0.3), {-2, -1}, SnapKind::spacing);
}

TEST(Snap, StandsLevelWithOthers) {
  SnapTargets targets;
  targets.middles = {{3, 7}};
  expect_at(snap({3.1, -20}, targets, 0.3), {3, -20}, SnapKind::line);
}

TEST(Snap, KeepsRightAngles) {
  SnapTargets targets;
  targets.origin = glm::dvec2(1, 1);
  targets.ends = {{6, 2}};
  expect_at(snap({6, 2}, targets, 0.5, true), {6, 1}, SnapKind::right_angle);
  expect_at(snap({1.1, 9}, targets, 0.5), {1, 9}, SnapKind::right_angle);
  expect_at(snap({6.1, 2.1}, targets, 0.5), {6, 2}, SnapKind::end);
}

}  // namespace
}  // namespace parvis::planner
