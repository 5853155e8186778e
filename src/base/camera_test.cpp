#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/camera_check.h"
#include "base/random.h"

namespace parvis {
namespace {

glm::vec3 random_point(Random& random) {
  return {random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(0, 20)};
}

TEST(Camera, LooksWhereItShould) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const glm::vec3 eye = random_point(random), target = random_point(random);
    Camera camera;
    camera.world_from_camera = look_at(eye, target);
    ASSERT_LT(glm::distance(camera.position_in_world(), eye), 1e-3f);
    ASSERT_LT(glm::distance(camera.forward_in_world(), glm::normalize(target - eye)), 1e-4f);
    ASSERT_NEAR(camera.world_from_camera[0].z, 0.0f, 1e-4f) << "the horizon is level";
    ASSERT_GE(camera.world_from_camera[1].z, 0.0f) << "up is up";

    const glm::mat3 turn(camera.world_from_camera);
    const glm::mat3 identity = glm::transpose(turn) * turn;
    for (int c = 0; c < 3; ++c) ASSERT_LT(glm::distance(identity[c], glm::mat3(1.0f)[c]), 1e-4f) << "rigid";
    ASSERT_NEAR(glm::determinant(turn), 1.0f, 1e-4f);
  }
}

TEST(Camera, TheTargetIsTheMiddleOfThePicture) {
  Camera camera;
  camera.world_from_camera = look_at({3, -10, 2}, {0, 5, 1});
  const glm::vec4 clip = camera.clip_from_camera(1.5f) * camera.camera_from_world() * glm::vec4(0, 5, 1, 1);
  EXPECT_NEAR(clip.x / clip.w, 0.0f, 1e-5f);
  EXPECT_NEAR(clip.y / clip.w, 0.0f, 1e-5f);
}

TEST(Camera, TheFieldOfViewReachesFromEdgeToEdge) {
  Camera camera;
  camera.vertical_fov = 1.0f;
  const float top = std::tan(0.5f), aspect = 16.0f / 9.0f;
  const auto projected = [&](glm::vec3 point) {
    const glm::vec4 clip = camera.clip_from_camera(aspect) * glm::vec4(point, 1.0f);
    return glm::vec3(clip) / clip.w;
  };
  EXPECT_NEAR(projected({0, top * 10, -10}).y, 1.0f, 1e-5f);
  EXPECT_NEAR(projected({-top * aspect * 10, 0, -10}).x, -1.0f, 1e-5f);
  EXPECT_NEAR(projected({0, 0, -camera.near_m}).z, -1.0f, 1e-4f);
  EXPECT_NEAR(projected({0, 0, -camera.far_m}).z, 1.0f, 1e-4f);
}

TEST(Camera, AParallelViewShowsWidthsAtAnyDistanceAlike) {
  Camera camera;
  camera.parallel = ParallelView{20.0f, 300.0f};
  for (const float distance : {5.0f, 300.0f, 1000.0f}) {
    const glm::vec4 clip = camera.clip_from_camera(2.0f) * glm::vec4(20.0f, 10.0f, -distance, 1.0f);
    EXPECT_NEAR(clip.x / clip.w, 1.0f, 1e-5f);
    EXPECT_NEAR(clip.y / clip.w, 1.0f, 1e-5f);
  }
  EXPECT_NEAR(camera.height_at_1m() * 300.0f, 20.0f, 1e-4f);
  EXPECT_TRUE(is_usable(camera));
}

TEST(Camera, AHorizontalFieldOfViewGivesItsVerticalOne) {
  EXPECT_NEAR(vertical_fov(1.2f, 1.0f), 1.2f, 1e-6f);
  EXPECT_NEAR(std::tan(0.5f * vertical_fov(1.2f, 2.0f)) * 2.0f, std::tan(0.6f), 1e-6f);
}

TEST(Camera, ThoseOfNoNumbersAreNotUsable) {
  const float none = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(is_usable(Camera{}));
  for (const float value : {none, infinite, 1e30f}) {
    Camera far;
    far.world_from_camera[3].x = value;
    EXPECT_FALSE(is_usable(far)) << value;
    Camera turned;
    turned.world_from_camera[1].y = value;
    EXPECT_FALSE(is_usable(turned)) << value;
  }
  Camera at_itself;
  at_itself.world_from_camera = look_at(glm::vec3(1.0f), glm::vec3(1.0f));
  EXPECT_FALSE(is_usable(at_itself));
  Camera shut;
  shut.vertical_fov = none;
  EXPECT_FALSE(is_usable(shut));
}

}  // namespace
}  // namespace parvis
