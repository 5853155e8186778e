#include "capture/photographs/photograph.h"

#include <gtest/gtest.h>

namespace parvis::photographs {
namespace {

Photograph looking_north() {
  Camera camera;
  camera.world_from_camera = look_at({10.0f, 0.0f, 2.0f}, {10.0f, 5.0f, 2.0f});
  camera.vertical_fov = 1.0f;
  return photograph_of(camera, "north.jpg", 800, 600);
}

TEST(Photograph, ProjectsIntoPixelsAndBack) {
  const Photograph photograph = looking_north();
  const glm::dvec3 position(12.0, 8.0, 3.0);  // right of and above the axis
  const auto pixel = pixel_of_world(photograph, position);
  ASSERT_TRUE(pixel);
  EXPECT_GT(pixel->x, 400.0);
  EXPECT_LT(pixel->y, 300.0);
  const double distance = distance_along_axis(photograph, position);
  EXPECT_NEAR(distance, 8.0, 1e-6);
  const auto direction = direction_in_world(photograph, *pixel);
  ASSERT_TRUE(direction);
  EXPECT_LT(glm::distance(*direction, glm::normalize(position - photograph.position_in_world())), 1e-6);
}

TEST(Photograph, ItsCameraIsTheHouses) {
  const Photograph photograph = looking_north();
  const Camera camera = camera_of(photograph);
  EXPECT_NEAR(camera.vertical_fov, 1.0f, 1e-6f);
  EXPECT_LT(glm::distance(camera.forward_in_world(), {0.0f, 1.0f, 0.0f}), 1e-6f);
  EXPECT_LT(glm::distance(photograph.up_in_world(), {0.0, 0.0, 1.0}), 1e-6);
}

TEST(Photograph, OpencvPosesTurnIntoOursAndBack) {
  const Photograph photograph = looking_north();
  const glm::dmat4 pose = opencv_from_world(photograph);
  const glm::dvec4 p = pose * glm::dvec4(12.0, 8.0, 3.0, 1.0);
  EXPECT_NEAR(p.x, 2.0, 1e-6);
  EXPECT_NEAR(p.y, -1.0, 1e-6) << "y downward";
  EXPECT_NEAR(p.z, 8.0, 1e-6) << "z forward";
  const glm::dmat4 back = world_from_camera_of_opencv(pose);
  for (int column = 0; column < 4; ++column)
    EXPECT_LT(glm::distance(back[column], photograph.world_from_camera[column]), 1e-9);
}

TEST(Photograph, IsFoundByName) {
  PhotographSet set;
  set.photographs.push_back(looking_north());
  EXPECT_EQ(find(set, "north.jpg"), &set.photographs[0]);
  EXPECT_EQ(find(set, "south.jpg"), nullptr);
}

}  // namespace
}  // namespace parvis::photographs
