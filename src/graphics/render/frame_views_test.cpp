#include "graphics/render/frame_views.h"

#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "scene/data/test_scene.h"

namespace parvis::render {
namespace {

using scene::add, scene::box, scene::ground, scene::matt, scene::model_of;

/// Counts what the renderer asks of a drawable.
struct Counting final : Drawable {
  void update(const scene::Scene&) override { ++updates; }
  Extents extents() const override { return {}; }
  void prepare(const View& view, const Culling&) override {
    main_views += view.kind == ViewKind::main;
    shadow_views += view.kind == ViewKind::shadow;
  }
  void draw(const View&, Pass) override {}

  int updates = 0, main_views = 0, shadow_views = 0;
};

class FrameViewsTest : public gl::ContextTest {
 protected:
  void SetUp() override {
    gl::ContextTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    add(scene_, model_of(ground(40), matt(glm::vec3(0.5f))));
    add(scene_, model_of(box({-4, 8, 0}, {-1, 10, 5}), matt({0.7f, 0.3f, 0.2f})));
    add(scene_, model_of(box({9, -2, 0}, {11, 3, 4}), matt({0.2f, 0.3f, 0.7f})));
    add(scene_, model_of(box({1, 5, 0}, {2, 6, 2}), matt({0.2f, 0.6f, 0.3f})), true);
    renderer_ = fresh();
  }
  void TearDown() override { renderer_.reset(); }
  std::unique_ptr<Renderer> fresh() const {
    Result<std::unique_ptr<Renderer>> made = Renderer::create(scene_, {}, light::sun_and_sky);
    EXPECT_TRUE(made) << to_string(made.errors());
    return *std::move(made);
  }

  scene::Scene scene_;
  std::unique_ptr<Renderer> renderer_;
};

/// Northward at eye height, `right_m` to the right of the head.
Camera eye(float right_m) {
  Camera camera;
  camera.world_from_camera = look_at({right_m, 0, 1.7f}, {right_m, 10, 1.7f});
  return camera;
}

/// A wall of 4 x 2.5 m, 2 m north of the head, as one eye sees it.
Camera before_north_wall(float right_m) {
  Camera camera = eye(right_m);
  camera.off_axis = {(-2 - right_m) / 2, (2 - right_m) / 2, -0.6f, 0.65f};
  return camera;
}

/// The wall at its right hand.
Camera before_east_wall() {
  Camera camera;
  camera.world_from_camera = look_at({0, 0, 1.7f}, {10, 0, 1.7f});
  camera.off_axis = {-1.0f, 1.0f, -0.6f, 0.65f};
  return camera;
}

TEST(Camera, ASymmetricFrustumIsASpecialCaseOfFourTangents) {
  Camera symmetric, off_axis;
  symmetric.vertical_fov = 0.9f;
  off_axis.off_axis = symmetric.tangents(1.6f);
  const glm::mat4 a = symmetric.clip_from_camera(1.6f), b = off_axis.clip_from_camera(1.0f);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(a[i][j], b[i][j], 1e-5f) << i << ", " << j;
  EXPECT_FLOAT_EQ(symmetric.height_at_1m(), 2.0f * std::tan(0.45f));
  EXPECT_FLOAT_EQ(off_axis.height_at_1m(), symmetric.height_at_1m());
}

TEST_F(FrameViewsTest, AnOffAxisFrustumIsAPartOfASymmetricOne) {
  Camera whole;
  whole.world_from_camera = look_at({0, -4, 3}, {0, 6, 2});
  whole.vertical_fov = 0.5f * glm::pi<float>();
  ASSERT_TRUE(draw_frame(*renderer_, scene_, EyeView{whole, 160, 160}));
  const ObjectPicture objects = renderer_->pick(whole, 160, 160, true);
  Camera upper_right = whole;
  upper_right.off_axis = {0.0f, 1.0f, 0.0f, 1.0f};
  const ObjectPicture part = renderer_->pick(upper_right, 80, 80, true);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x) ASSERT_EQ(*part.at(x, y), *objects.at(x + 80, y)) << x << ", " << y;
}

TEST_F(FrameViewsTest, TwoEyesAndAWallBesideThemAreDrawnInOneFrame) {
  const std::vector<EyeView> eyes{{before_north_wall(-0.032f), 160, 100},
                                  {before_north_wall(0.032f), 160, 100},
                                  {before_east_wall(), 120, 90}};
  Counting counting;
  renderer_->add(&counting);
  std::vector<Camera> reflected;
  std::vector<std::string> passes;
  FrameSteps steps;
  steps.reflect = [&](const Camera& camera) { reflected.push_back(camera); };
  steps.end_pass = [&](const char* pass) { passes.push_back(pass); };
  ASSERT_TRUE(draw_frame(*renderer_, scene_, eyes, steps));
  EXPECT_EQ(counting.updates, 1);
  EXPECT_EQ(counting.main_views, 3);
  EXPECT_EQ(counting.shadow_views, 3)
      << "the far map, the near one without and with dynamic casters: once for all";
  ASSERT_EQ(reflected.size(), 3u);
  EXPECT_EQ(passes, (std::vector<std::string>{"shadows", "reflections", "picture", "reflections", "picture",
                                              "reflections", "picture"}));

  for (std::size_t i = 0; i < eyes.size(); ++i) {
    renderer_->select_eye(i);
    EXPECT_EQ(renderer_->width(), eyes[i].width);
    EXPECT_EQ(reflected[i].world_from_camera, eyes[i].camera.world_from_camera);
    const ImageF in_one_frame = renderer_->read_radiance();
    const auto alone = fresh();  // each eye by itself, with the shadow maps of all
    alone->begin_frame(scene_, middle_of(eyes));
    alone->prepare_main_view(eyes[i].camera, eyes[i].width, eyes[i].height);
    alone->draw_main_view();
    EXPECT_EQ(in_one_frame.pixels, alone->read_radiance().pixels) << "eye " << i;
  }
  renderer_->select_eye(0);
  const ImageF left = renderer_->read_radiance();
  renderer_->select_eye(1);
  EXPECT_NE(left.pixels, renderer_->read_radiance().pixels) << "the two eyes see a little different";
}

TEST(FrameViews, TheMiddleOfTwoEyesIsTheHead) {
  const std::vector<EyeView> eyes{{eye(-0.032f), 10, 10}, {eye(0.032f), 10, 10}};
  const Camera head = middle_of(eyes);
  EXPECT_LT(glm::distance(head.position_in_world(), glm::vec3(0, 0, 1.7f)), 1e-6f);
  EXPECT_LT(glm::distance(head.forward_in_world(), glm::vec3(0, 1, 0)), 1e-6f);
  EXPECT_EQ(middle_of(std::span(eyes).first(1)).world_from_camera, eyes[0].camera.world_from_camera);
  const std::vector<EyeView> back_to_back{{before_east_wall(), 10, 10},
                                          {[] {
                                             Camera west = before_east_wall();
                                             west.world_from_camera = look_at({0, 0, 1.7f}, {-10, 0, 1.7f});
                                             return west;
                                           }(),
                                           10, 10}};
  EXPECT_LT(glm::distance(middle_of(back_to_back).forward_in_world(), glm::vec3(1, 0, 0)), 1e-5f);
}

}  // namespace
}  // namespace parvis::render
