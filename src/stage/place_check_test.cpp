#include "stage/place_check.h"

#include <gtest/gtest.h>

#include "scene/data/test_scene.h"

namespace parvis::stage {
namespace {

scene::Scene house_with_camera(glm::vec3 eye) {
  scene::Scene place;
  scene::add(place, scene::model_of(scene::ground(100), scene::matt(glm::vec3(0.3f))));
  const int house =
      scene::add(place, scene::model_of(scene::box({0, 0, 0}, {10, 8, 9}), scene::matt(glm::vec3(0.5f))));
  place.objects[std::size_t(house)].name = "town hall";
  scene::NamedCamera camera;
  camera.name = "eye";
  camera.camera.world_from_camera = look_at(eye, eye + glm::vec3(0, 1, 0));
  place.cameras.push_back(camera);
  return place;
}

TEST(PlaceCheck, ACameraInAHouseIsNamedWithTheHouse) {
  const Errors warnings = check_place(house_with_camera({5, 4, 1.7f}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(to_string(warnings).find("camera \"eye\" stands inside \"town hall\""), std::string::npos)
      << to_string(warnings);
}

TEST(PlaceCheck, ACameraInTheStreetOrOnARoofIsRight) {
  for (const glm::vec3 eye : {glm::vec3(5, -4, 1.7f), glm::vec3(5, 4, 10.7f), glm::vec3(-0.2f, 4, 1.7f)})
    EXPECT_TRUE(check_place(house_with_camera(eye)).empty());
}

TEST(PlaceCheck, ACameraThatFollowsIsLeftOut) {
  scene::Scene place = house_with_camera({5, 4, 1.7f});
  place.cameras.front().follows = "tram";
  EXPECT_TRUE(check_place(place).empty());
}

TEST(PlaceCheck, ACameraInTheCarThatItFollowsIsNamedWithTheCar) {
  scene::Scene place = house_with_camera({5, -20, 1.7f});
  const int car = scene::add(
      place, scene::model_of(scene::box({-2, -0.9f, 0.2f}, {2, 0.9f, 1.5f}), scene::matt(glm::vec3(0.5f))));
  place.objects[std::size_t(car)].name = "taxi";
  place.objects[std::size_t(car)].is_dynamic = true;
  place.objects[std::size_t(car)].world_from_model[3] = glm::vec4(40, 3, 0, 1);
  scene::NamedCamera& camera = place.cameras.front();
  camera.follows = "taxi", camera.camera.world_from_camera = glm::mat4(1.0f);
  camera.offset_m = {-7, 2, 1.8f};
  EXPECT_TRUE(check_place(place).empty());
  camera.offset_m = {0.4f, 0.3f, 1.1f};
  const Errors warnings = check_place(place);
  ASSERT_EQ(warnings.size(), 1u) << to_string(warnings);
  EXPECT_NE(to_string(warnings).find("camera \"eye\" stands inside \"taxi\""), std::string::npos)
      << to_string(warnings);
}

TEST(PlaceCheck, WhatIsHiddenIsNotThere) {
  scene::Scene place = house_with_camera({5, 4, 1.7f});
  place.objects.back().is_visible = false;
  EXPECT_TRUE(check_place(place).empty());
}

TEST(PlaceCheck, RoadsOverNothingAreNamed) {
  scene::Scene place = house_with_camera({5, -4, 1.7f});
  place.roads.lanes.emplace_back().points = {{-50, -20, 0}, {0, -20, 0}, {50, -20, 0}};
  EXPECT_TRUE(check_place(place).empty());
  place.objects.front().is_visible = false;
  const Errors warnings = check_place(place);
  ASSERT_EQ(warnings.size(), 1u) << to_string(warnings);
  EXPECT_NE(to_string(warnings).find("nothing lies below the roads"), std::string::npos);
}

}  // namespace
}  // namespace parvis::stage
