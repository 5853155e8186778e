#include "planning/plan_drawing/sun_difference.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/data/test_scene.h"

namespace parvis::plan_drawing {
namespace {

sun_hours::SunPeriod equinox() {
  sun_hours::SunPeriod period;
  period.place.year = 2026, period.place.latitude_deg = 43.7, period.place.longitude_deg = 7.27;
  period.place.time_zone_h = 1.0;
  period.first_day = period.last_day = 80;
  return period;
}

/// A level square with a box of 4 x 4 x 3 m on it, or without.
scene::Scene square(bool has_box) {
  scene::Scene scene;
  scene::add(scene, scene::model_of(scene::ground(40), scene::matt(glm::vec3(0.3f))));
  if (has_box)
    scene::add(scene, scene::model_of(scene::box({-2, -2, 0}, {2, 2, 3}), scene::matt(glm::vec3(0.3f))));
  return scene;
}

TEST(SunDifference, ABoxTakesSunFromTheGroundNorthOfIt) {
  const auto made =
      sun_difference(square(false), square(false), square(true), equinox(), {-8, -8, 8, 8}, 0.5);
  ASSERT_TRUE(made) << to_string(made.errors());
  EXPECT_EQ(made->columns, 32);
  EXPECT_NEAR(made->area_m2(), 256.0, 1e-6) << "the ground without the designs";
  EXPECT_NEAR(made->mean_hours(made->before), made->max_hours, 0.1) << "an open plain";
  EXPECT_LT(made->mean_hours(made->after), made->mean_hours(made->before));
  const auto hours_at = [&](double x, double y) {
    const int column = int((x - made->corner.x) / made->cell_m),
              row = int((y - made->corner.y) / made->cell_m);
    return made->after[std::size_t(row * made->columns + column)];
  };
  EXPECT_EQ(hours_at(0.1, 0.1), 0.0f) << "below the box";
  EXPECT_LT(hours_at(0.1, 3.1), hours_at(0.1, -3.1)) << "north of it, south of it";
  EXPECT_GT(made->area_changed_m2(-1.0), 16.0);
  EXPECT_EQ(made->area_changed_m2(1.0), 0.0);
  EXPECT_LT(made->area_with_m2(made->after, 2.0), made->area_with_m2(made->before, 2.0));
}

TEST(SunDifference, WhatStaysAsItIsChangesNothing) {
  const auto made = sun_difference(square(false), square(true), square(true), equinox(), {-8, -8, 8, 8}, 1.0);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->before, made->after);
  EXPECT_EQ(made->area_changed_m2(0.01), 0.0);
}

TEST(SunDifference, AnAreaWithoutGroundIsAnError) {
  EXPECT_FALSE(
      sun_difference(square(false), square(false), square(true), equinox(), {100, 100, 110, 110}, 1.0));
}

}  // namespace
}  // namespace parvis::plan_drawing
