#include "viewer/navigation.h"

#include <gtest/gtest.h>

namespace parvis::viewer {
namespace {

Camera at_origin_looking_north() {
  Camera camera;
  camera.world_from_camera = look_at({0, 0, 1.6f}, {0, 10, 1.6f});
  return camera;
}

const glm::mat4 nothing(1.0f);

TEST(Navigation, KeepsTheCameraThatItBeganWith) {
  const Camera start = at_origin_looking_north();
  const Camera camera = Navigation(start).camera();
  EXPECT_NEAR(glm::distance(camera.position_in_world(), start.position_in_world()), 0.0f, 1e-5f);
  EXPECT_NEAR(glm::distance(camera.forward_in_world(), start.forward_in_world()), 0.0f, 1e-5f);
}

TEST(Navigation, WalksLevelEvenWhenLookingUp) {
  Navigation visitor(at_origin_looking_north());
  Controls look_up, forward;
  look_up.turn.y = 1.0f;
  forward.move = {1, 0, 1};
  visitor.step(look_up, 0.0f, nothing);
  visitor.step(forward, 1.0f, nothing);
  const glm::vec3 position = visitor.camera().position_in_world();
  EXPECT_NEAR(position.x, 0.0f, 1e-4f);
  EXPECT_GT(position.y, 1.0f);
  EXPECT_NEAR(position.z, 1.6f, 1e-5f);
}

TEST(Navigation, FliesWhereItLooks) {
  Navigation visitor(at_origin_looking_north());
  visitor.set_mode(Mode::fly);
  Controls controls;
  controls.turn.y = 0.5f;
  controls.move.x = 1.0f;
  visitor.step(controls, 1.0f, nothing);
  const glm::vec3 moved = visitor.camera().position_in_world() - glm::vec3(0, 0, 1.6f);
  EXPECT_NEAR(std::atan2(moved.z, moved.y), 0.5f, 1e-4f);
}

TEST(Navigation, FollowedObjectStaysInTheMiddleOfThePicture) {
  Navigation visitor(at_origin_looking_north());
  visitor.set_mode(Mode::follow);
  Controls controls;
  controls.turn = {0.7f, -0.3f};
  visitor.step(controls, 0.1f, glm::translate(glm::mat4(1.0f), {50, 20, 0}));
  const Camera camera = visitor.camera();
  const glm::vec4 in_camera = camera.camera_from_world() * glm::vec4(50, 20, 0.9f, 1);
  EXPECT_NEAR(in_camera.x, 0.0f, 1e-3f);
  EXPECT_NEAR(in_camera.y, 0.0f, 1e-3f);
  EXPECT_LT(in_camera.z, 0.0f);
}

TEST(Navigation, PitchStopsShortOfTheZenith) {
  Navigation visitor(at_origin_looking_north());
  Controls controls;
  controls.turn.y = 100.0f;
  visitor.step(controls, 0.1f, nothing);
  EXPECT_GT(visitor.camera().forward_in_world().y, 0.0f);
}

}  // namespace
}  // namespace parvis::viewer
