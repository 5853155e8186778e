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

Camera plan(float height_m, glm::vec2 middle) {
  Camera camera;
  camera.parallel = ParallelView{height_m, 300.0f};
  camera.world_from_camera = look_at({middle, 300.0f}, {middle, 0.0f}, {0.0f, 1.0f, 0.0f});
  return camera;
}

TEST(Navigation, AFlightEasesAndKeepsTheHorizonUntilItIsThere) {
  Navigation visitor(at_origin_looking_north());
  Camera there;
  there.world_from_camera = look_at({20, 5, 9}, {0, 10, 1});
  visitor.fly_to(there, 1.5f);
  glm::vec3 last = visitor.camera().position_in_world();
  std::vector<float> steps;
  for (int i = 0; i < 16; ++i) {
    visitor.step({}, 0.1f, nothing);
    EXPECT_NEAR(visitor.camera().world_from_camera[0].z, 0.0f, 1e-4f) << "the horizon is level";
    steps.push_back(glm::distance(visitor.camera().position_in_world(), last));
    last = visitor.camera().position_in_world();
  }
  EXPECT_LT(steps[0], 0.5f * steps[7]);
  EXPECT_LT(steps[13], 0.5f * steps[7]);
  EXPECT_FALSE(visitor.is_flying_to());
  EXPECT_LT(glm::distance(last, glm::vec3(20, 5, 9)), 1e-3f);
  EXPECT_EQ(visitor.mode(), Mode::walk) << "as before";
}

TEST(Navigation, AnyMotionEndsAFlight) {
  Navigation visitor(at_origin_looking_north());
  visitor.fly_to(plan(30.0f, {4, 4}), 1.0f);
  Controls controls;
  controls.move.x = 1.0f;
  visitor.step(controls, 0.1f, nothing);
  EXPECT_FALSE(visitor.is_flying_to());
}

TEST(Navigation, APlanIsZoomedAtThePointerAndDrawnAlong) {
  Navigation visitor(at_origin_looking_north());
  visitor.fly_to(plan(30.0f, {4, 6}), 1.0f);
  for (int i = 0; i < 12; ++i) visitor.step({}, 0.1f, nothing);
  ASSERT_EQ(visitor.mode(), Mode::plan);
  ASSERT_TRUE(visitor.camera().parallel);
  const auto at = [&](glm::vec2 from_middle) {  // in heights of the picture
    return glm::vec2(visitor.camera().position_in_world()) +
           visitor.camera().parallel->height_m * from_middle;
  };
  const glm::vec2 pointer(0.3f, -0.2f), below = at(pointer);
  Controls wheel;
  wheel.zoom = 3.0f, wheel.zoom_at = pointer;
  visitor.step(wheel, 0.1f, nothing);
  EXPECT_LT(visitor.camera().parallel->height_m, 20.0f);
  EXPECT_LT(glm::distance(at(pointer), below), 1e-3f) << "what lies below the pointer stays there";
  Controls drawn;
  drawn.pan = {0.1f, 0.0f};
  const glm::vec2 moved = at(pointer + drawn.pan);
  visitor.step(drawn, 0.1f, nothing);
  EXPECT_LT(glm::distance(at(pointer + 2.0f * drawn.pan), moved), 1e-3f);
}

TEST(Navigation, OnFootItGoesWhereItMay) {
  Navigation visitor(at_origin_looking_north());
  visitor.on_foot = [](glm::vec3, glm::vec3 to) -> std::optional<glm::vec3> {
    if (to.y > 3.0f) return std::nullopt;
    return to + glm::vec3(0.0f, 0.0f, 0.1f);
  };
  Controls forward;
  forward.move.x = 1.0f;
  for (int i = 0; i < 40; ++i) visitor.step(forward, 0.1f, nothing);
  const glm::vec3 reached = visitor.camera().position_in_world();
  EXPECT_LE(reached.y, 3.0f);
  EXPECT_GT(reached.y, 2.0f);
  EXPECT_GT(reached.z, 2.0f) << "it climbs";
}

TEST(Navigation, ASlowFrameGoesAsFarAsManyFastOnesAndThroughNoWall) {
  Controls forward;
  forward.move.x = 1.0f;
  const auto reached = [&](int frames, float seconds) {
    Navigation visitor(at_origin_looking_north());
    visitor.on_foot = [](glm::vec3, glm::vec3 to) {  // a wall 5 cm thick
      return to.y > 1.0f && to.y < 1.2f ? std::nullopt : std::optional(to);
    };
    for (int i = 0; i < frames; ++i) visitor.step(forward, seconds, nothing);
    return visitor.camera().position_in_world().y;
  };
  EXPECT_NEAR(reached(1, 0.5f), reached(5, 0.1f), 1e-3f);
  EXPECT_GT(reached(1, 0.5f), 0.7f);
  EXPECT_LT(reached(2, 1.0f), 1.0f);
}

}  // namespace
}  // namespace parvis::viewer
