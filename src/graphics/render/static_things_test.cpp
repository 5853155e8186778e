#include "graphics/render/static_things.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace parvis::render {
namespace {

const int shape = 0, other_shape = 0;
const Bounds unit{{0, 0, 0}, {1, 1, 1}};

StaticThing thing_at(float x, const void* of = &shape, bool is_visible = true) {
  const glm::mat4 place = glm::translate(glm::mat4(1.0f), {x, 0, 0});
  return {of, place, is_visible, transformed(place, unit), transformed(place, unit)};
}

void update(StaticThings& things, const std::vector<StaticThing>& now, bool look_alike = true) {
  things.begin_update(now.size(), look_alike);
  for (std::size_t i = 0; i < now.size(); ++i) things.update(i, now[i]);
}

std::pair<std::size_t, std::size_t> gone_and_come(const StaticThings& things) {
  const FixedChange& change = *things.extents().fixed_change;
  return {change.gone.size(), change.come.size()};
}
using Counts = std::pair<std::size_t, std::size_t>;

TEST(StaticThings, WhatStaysHasNotChanged) {
  StaticThings things;
  update(things, {thing_at(0), thing_at(5)});
  EXPECT_EQ(gone_and_come(things), Counts(0, 2));
  EXPECT_TRUE(things.is_newcomer(1));
  update(things, {thing_at(0), thing_at(5)});
  EXPECT_EQ(gone_and_come(things), Counts(0, 0));
  EXPECT_FALSE(things.is_newcomer(1));
  EXPECT_EQ(things.extents().fixed.max.x, 6.0f);
}

TEST(StaticThings, WhatIsMovedIsGoneAndCome) {
  StaticThings things;
  update(things, {thing_at(0), thing_at(5)});
  update(things, {thing_at(0), thing_at(7)});
  EXPECT_EQ(gone_and_come(things), Counts(1, 1));
  EXPECT_EQ(things.extents().fixed_change->gone.front().min.x, 5.0f);
  EXPECT_EQ(things.bounds(1).min.x, 7.0f);
  EXPECT_TRUE(things.extents().fixed_change->has_moved);
}

/// A shape of the same size takes the other's place: their bounds alone are equal.
TEST(StaticThings, AnotherShapeInTheSamePlaceIsAChange) {
  StaticThings things;
  update(things, {thing_at(0, &shape)});
  update(things, {thing_at(0, &other_shape)});
  EXPECT_EQ(gone_and_come(things), Counts(1, 1));
}

TEST(StaticThings, WhatIsHiddenKeepsItsPlaceInWhatIsFixed) {
  StaticThings things;
  update(things, {thing_at(0), thing_at(5)});
  update(things, {thing_at(0), thing_at(5, &shape, false)});
  EXPECT_EQ(gone_and_come(things), Counts(1, 0));
  EXPECT_TRUE(things.bounds(1).empty());
  EXPECT_EQ(things.extents().fixed.max.x, 6.0f);
  update(things, {thing_at(0), thing_at(5)});
  EXPECT_EQ(gone_and_come(things), Counts(0, 1));
}

TEST(StaticThings, ThoseThatAreTakenAwayAreGone) {
  StaticThings things;
  update(things, {thing_at(0), thing_at(5)});
  update(things, {thing_at(0)});
  EXPECT_EQ(gone_and_come(things), Counts(1, 0));
}

TEST(StaticThings, AnotherLookChangesAll) {
  StaticThings things;
  update(things, {thing_at(0), thing_at(5)});
  update(things, {thing_at(0), thing_at(5)}, false);
  EXPECT_EQ(gone_and_come(things), Counts(2, 2));
}

}  // namespace
}  // namespace parvis::render
