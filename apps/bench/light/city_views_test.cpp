// The views from which shadows are judged.
#include "bench/light/city_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/data/test_scene.h"

namespace parvis::bench {
namespace {

constexpr int width = 64, height = 36;
constexpr std::size_t count = 24;
constexpr float house_half_m = 20.0f, house_height_m = 15.0f;

/// A lane that a house stands across.
scene::Scene built_over_lane() {
  scene::Scene scene;
  add(scene, scene::model_of(scene::ground(60), scene::matt(glm::vec3(0.5f))));
  add(scene, scene::model_of(scene::box({-house_half_m, -5, 0}, {house_half_m, 5, house_height_m}),
                             scene::matt(glm::vec3(0.5f))));
  scene.roads.lanes.push_back({.points = {{-50, 0, 0}, {50, 0, 0}}, .next = {}});
  return scene;
}

TEST(CityViews, StandInPlacesOfTheirOwnAndInNoHouse) {
  const scene::Scene scene = built_over_lane();
  const DoubleTracer tracer(opaque_twin(scene));
  const auto views = city_views(scene, tracer, count, width, height);
  ASSERT_TRUE(views) << to_string(views.errors());
  ASSERT_EQ(views->size(), count);
  int low = 0, high = 0, above_house = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 eye = (*views)[i].position_in_world();
    for (std::size_t other = 0; other < i; ++other)
      EXPECT_GT(glm::distance(glm::vec2(eye), glm::vec2((*views)[other].position_in_world())), 0.0f);
    const bool is_over_house = std::abs(eye.x) < house_half_m;
    EXPECT_FALSE(is_over_house && eye.z < house_height_m) << "inside of the house, at " << eye.x;
    low += eye.z<2.0f, high += eye.z> 50.0f, above_house += is_over_house;
  }
  EXPECT_EQ(low, 12) << "half of them at the height of eyes";
  EXPECT_EQ(high, 6) << "a quarter from above the roofs";
  EXPECT_GT(above_house, 0) << "the lane's places below the house are asked for, too";
}

TEST(CityViews, FailWithoutLanesOrFreePlaces) {
  scene::Scene scene = built_over_lane();
  add(scene, scene::model_of(scene::box({-60, -10, -1}, {60, 10, 200}), scene::matt(glm::vec3(0.5f))));
  EXPECT_FALSE(city_views(scene, DoubleTracer(opaque_twin(scene)), count, width, height))
      << "a body about all of the lane";
  scene.roads.lanes.clear();
  EXPECT_FALSE(city_views(scene, DoubleTracer(opaque_twin(scene)), count, width, height));
}

}  // namespace
}  // namespace parvis::bench
