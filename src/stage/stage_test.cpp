// The renderer against the ray tracer on a street that has something of everything: walls in sun and shade,
// ground, a fence with holes, a pane that lets through, a lacquered car that reflects and darkens the road
// below it.
#include "stage/stage.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "graphics/gl/test_context.h"
#include "graphics/reference/metrics.h"
#include "graphics/shading/tone_curve.h"
#include "reflections/methods/settings.h"
#include "rooms/rooms.h"
#include "scene/data/object_animation.h"
#include "scene/data/test_scene.h"
#include "stage/kept_rays.h"
#include "stage/stillness.h"

namespace parvis::stage {
namespace {

using scene::add, scene::box, scene::ground, scene::matt, scene::model_of, scene::quad;

class StageTest : public gl::ContextTest {};

scene::Material lacquer() {
  scene::Material paint = matt({0.4f, 0.05f, 0.04f});
  paint.roughness = 0.5f;
  paint.clear_coat = 1.0f;
  paint.clear_coat_roughness = 0.03f;
  paint.is_mirror_like = true;
  return paint;
}

scene::Material tinted_glass() {
  scene::Material glass = matt({0.05f, 0.07f, 0.06f});
  glass.roughness = 0.2f;
  glass.alpha = 0.5f;
  glass.alpha_mode = scene::Alpha::blend;
  glass.is_double_sided = true;
  return glass;
}

/// Bars 0.25 m wide, 0.5 m from middle to middle.
std::shared_ptr<scene::Model> fence() {
  Image8 bars(64, 4, 4, 255);
  for (int y = 0; y < bars.height; ++y)
    for (int x = 0; x < bars.width; ++x) bars.at(x, y)[3] = x % 8 < 4 ? 255 : 0;
  scene::Material iron = matt(glm::vec3(0.1f));
  iron.alpha_mode = scene::Alpha::cutout;
  iron.is_double_sided = true;
  iron.base_colour_texture = 0;
  auto model = std::make_shared<scene::Model>(
      *model_of(quad({-6, 3, 0}, {-2, 3, 0}, {-2, 3, 1.2f}, {-6, 3, 1.2f}), iron));
  model->textures.push_back({"bars", bars, true, scene::Wrap::clamp, scene::Wrap::clamp});
  return model;
}

scene::Scene street() {
  scene::Scene scene;
  add(scene, model_of(ground(40), matt(glm::vec3(0.25f))));
  add(scene, model_of(box({-20, 8, 0}, {-3, 16, 9}), matt({0.6f, 0.42f, 0.2f})));
  add(scene, model_of(box({-1, 8, 0}, {14, 16, 12}), matt({0.5f, 0.48f, 0.44f})));
  add(scene, fence());
  add(scene, model_of(quad({3, 4, 0.2f}, {6, 4, 0.2f}, {6, 4, 2.5f}, {3, 4, 2.5f}), tinted_glass()));
  const int car = add(scene, model_of(box({-2.1f, -0.9f, 0.25f}, {2.1f, 0.9f, 1.4f}), lacquer()), true);
  scene.objects[std::size_t(car)].takes_reflection = true;
  scene.sun.direction_to_sun = glm::normalize(glm::vec3(-0.6f, -0.4f, 0.7f));
  scene.haze_per_m = 0.002f;
  methods::settings(scene) = {"rerendered_cube_map", 256, false};
  return scene;
}

TEST_F(StageTest, AStreetIsWhatTheRayTracerSays) {
  constexpr int width = 480, height = 270;
  Result<std::unique_ptr<Stage>> stage = Stage::create(make_simulation(rooms::all_registries(), street()));
  ASSERT_TRUE(stage) << to_string(stage.errors());
  Camera camera;
  camera.world_from_camera = look_at({-5.5f, -6.5f, 1.7f}, {0, 1.5f, 1.2f});
  camera.vertical_fov = glm::radians(50.0f);
  (*stage)->draw(camera, width, height);
  const Image8 drawn = (*stage)->picture();
  const reference::TracedPicture truth = (*stage)->trace(camera, width, height, 16);
  const Image8 traced = shading::tone_mapped_picture(truth.radiance, (*stage)->scene().exposure);

  const Result<reference::Difference> everywhere = reference::compare(drawn, traced);
  ASSERT_TRUE(everywhere) << to_string(everywhere.errors());
  // Four samples per pixel against sixteen, and reflections of one map: the rest is equal.
  EXPECT_LT(everywhere->flip, 0.02);
  EXPECT_GT(everywhere->psnr, 43.0);
  const Result<reference::Difference> mirrors = reference::compare(drawn, traced, truth.mirror_mask);
  ASSERT_TRUE(mirrors) << to_string(mirrors.errors());
  EXPECT_LT(mirrors->flip,
            0.08);  // the map has one centre: walls at 8 m stand a little aside of where they are

  // Another light is another picture: the check can fail.
  (*stage)->simulation().scene.sun.direction_to_sun = glm::normalize(glm::vec3(-0.4f, -0.6f, 0.7f));
  (*stage)->draw(camera, width, height);
  const Result<reference::Difference> later = reference::compare((*stage)->picture(), traced);
  ASSERT_TRUE(later) << to_string(later.errors());
  EXPECT_GT(later->flip, 0.04);
}

/// Glass over a method with cube maps: light that leaves it is looked up in the map of its surroundings.
TEST_F(StageTest, AGlassBallShowsItsCubeMapUpsideDown) {
  constexpr int width = 240, height = 180;
  scene::Scene scene = street();
  scene::Material glass;
  glass.ior = 1.5f;
  glass.roughness = 0.0f;
  glass.is_mirror_like = true;
  const int ball = add(scene, model_of(scene::sphere(glm::vec3(0.0f), 1.0f, 48), glass), true,
                       glm::translate(glm::mat4(1.0f), {-3.5f, -2.0f, 1.2f}));
  scene.objects[std::size_t(ball)].takes_reflection = true;
  Camera camera;
  camera.world_from_camera = look_at({-4.5f, -6.5f, 1.7f}, {-3.5f, -2.0f, 1.2f});
  const auto flip_of = [&](const std::string& method) {
    methods::settings(scene).method = method;
    Result<std::unique_ptr<Stage>> stage = Stage::create(make_simulation(rooms::all_registries(), scene));
    EXPECT_TRUE(stage) << to_string(stage.errors());
    (*stage)->draw(camera, width, height);
    const Image8 drawn = (*stage)->picture();
    const reference::TracedPicture truth = (*stage)->trace(camera, width, height, 16);
    return reference::compare(drawn, shading::tone_mapped_picture(truth.radiance, scene.exposure),
                              truth.mirror_mask)
        ->flip;
  };
  const double by_map = flip_of("rerendered_cube_map");
  EXPECT_LT(by_map, 0.15);
  EXPECT_GT(flip_of("none"), 1.5 * by_map);
}

TEST_F(StageTest, ABudgetIsHeldByDrawingFewerPixelsInWindowsAlone) {
  constexpr int width = 160, height = 90, frames = 12;  // times come frames later
  scene::Scene scene = street();
  methods::settings(scene).budget_ms = 0.001f;
  Result<std::unique_ptr<Stage>> stage = Stage::create(make_simulation(rooms::all_registries(), scene));
  ASSERT_TRUE(stage) << to_string(stage.errors());
  Camera camera;
  camera.world_from_camera = look_at({-5.5f, -6.5f, 1.7f}, {0, 1.5f, 1.2f});
  for (int frame = 0; frame < frames; ++frame) (*stage)->draw(camera, width, height);
  EXPECT_EQ((*stage)->renderer().width(), width);
  for (int frame = 0; frame < frames; ++frame) {
    (*stage)->follow_clock(1e3);
    (*stage)->draw(camera, width, height);
  }
  EXPECT_LT((*stage)->renderer().width(), width);
  EXPECT_EQ((*stage)->width(), width);
}

TEST_F(StageTest, AHeldRateDrawsFewerPixelsUntilNothingMoves) {
  constexpr int width = 160, height = 90, frames = 12;
  Result<std::unique_ptr<Stage>> stage = Stage::create(make_simulation(rooms::all_registries(), street()));
  ASSERT_TRUE(stage) << to_string(stage.errors());
  Camera camera;
  camera.world_from_camera = look_at({-5.5f, -6.5f, 1.7f}, {0, 1.5f, 1.2f});
  const auto move = [&] {
    for (int frame = 0; frame < frames; ++frame) {
      (*stage)->draw(camera, width, height);
      (*stage)->follow_clock(1e3);
    }
    return (*stage)->drawn_share();
  };
  EXPECT_EQ(move(), 1.0) << "no rate is held";
  (*stage)->hold_rate(1e6);
  EXPECT_LT(move(), 0.5);
  EXPECT_LT((*stage)->picture().width, width);
  EXPECT_EQ((*stage)->whole_picture().width, width) << "what is asked for is drawn whole";
  EXPECT_LT(move(), 0.5);
  (*stage)->refine(camera, width, height);
  EXPECT_EQ((*stage)->drawn_share(), 1.0) << "at rest";
  (*stage)->draw(camera, width, height);
  EXPECT_LT((*stage)->drawn_share(), 0.5);
}

/// The picture converges to that of `parvis reference`, from which the drawn one differs; any new frame ends
/// it.
TEST_F(StageTest, AtRestThePictureBecomesTheReferencePicture) {
  constexpr int width = 96, height = 72, rounds = 600;
  scene::Scene scene = street();
  methods::settings(scene).method = "none";
  Result<std::unique_ptr<Stage>> stage =
      Stage::create(make_simulation(rooms::all_registries(), std::move(scene)));
  ASSERT_TRUE(stage) << to_string(stage.errors());
  Camera camera;
  camera.world_from_camera = look_at({-5.5f, -6.5f, 1.7f}, {0, 1.5f, 1.2f});
  const auto refine_to = [&](int samples) {
    for (int round = 0; round < rounds && (*stage)->refined_samples() < samples; ++round) {
      (*stage)->refine(camera, width, height);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    ASSERT_GE((*stage)->refined_samples(), samples);
  };
  (*stage)->draw(camera, width, height);
  const Image8 drawn = (*stage)->picture();
  refine_to(render::samples_per_pixel);
  const Image8 early = (*stage)->picture();
  refine_to(64);
  const Image8 refined = (*stage)->picture();
  (*stage)->draw(camera, width, height);
  EXPECT_EQ((*stage)->refined_samples(), 0);
  EXPECT_EQ((*stage)->picture().pixels, drawn.pixels);

  const reference::TracedPicture truth = (*stage)->trace(camera, width, height, 256);
  const auto flip_of = [&](const Image8& picture) {
    return reference::compare(picture,
                              shading::tone_mapped_picture(truth.radiance, (*stage)->scene().exposure))
        ->flip;
  };
  const double by_drawing = flip_of(drawn), at_first = flip_of(early), at_rest = flip_of(refined);
  fmt::print("FLIP drawn {:.4f}, {} rays {:.4f}, 64 rays {:.4f}\n", by_drawing, render::samples_per_pixel,
             at_first, at_rest);
  EXPECT_LT(at_rest, 0.5 * at_first);
  EXPECT_LT(at_rest, 0.25 * by_drawing);
}

/// The ray tracer built for the first picture at rest follows whatever has moved, appeared and changed its
/// shape since.
TEST(KeptRaysTest, FollowTheScene) {
  scene::Scene scene;
  const auto board = model_of(quad({0, 0, 0}, {0, 2, 0}, {0, 2, 3}, {0, 0, 3}), matt({0.7f, 0.2f, 0.1f}));
  board->materials[0].is_double_sided = true;
  add(scene, model_of(ground(4), matt(glm::vec3(0.25f))));
  add(scene, board);
  scene.objects.back().is_dynamic = true;
  KeptRays kept;
  const auto hit_at = [&]() -> float {
    std::optional<KeptRays::Moment> moment;
    while (!moment) moment = kept.of(scene, std::chrono::milliseconds(100));
    const auto hit = moment->rays->nearest_hit({{3.0f, 1.0f, 1.0f}, {-1.0f, 0.0f, 0.0f}});
    return hit ? hit->distance_m : -1.0f;
  };
  EXPECT_NEAR(hit_at(), 3.0f, 1e-4f);
  scene.objects[1].world_from_model[3].x = 1.0f;
  EXPECT_NEAR(hit_at(), 2.0f, 1e-4f);
  scene.objects[1].is_visible = false;
  EXPECT_EQ(hit_at(), -1.0f);
  scene.objects[1].is_visible = true;
  scene.objects.push_back(scene.objects[1]);  // other objects: it is a new one is built
  scene.objects[2].world_from_model[3].x = 2.0f;
  EXPECT_NEAR(hit_at(), 1.0f, 1e-4f);
}

TEST(StillnessTest, EndsWhenViewOrSceneChange) {
  scene::Scene scene;
  add(scene, model_of(ground(4), matt(glm::vec3(0.25f))));
  Camera camera;
  Stillness stillness;
  const auto frames = [&](int count) {
    for (int frame = 0; frame < count; ++frame) stillness.add_frame(scene, camera, 64, 48, 0.1);
    return stillness.rests();
  };
  EXPECT_FALSE(frames(2));
  EXPECT_TRUE(frames(8));
  camera.world_from_camera[3].x += 1e-4f;
  EXPECT_FALSE(frames(1));
  EXPECT_TRUE(frames(8));
  scene.objects[0].world_from_model[3].x += 1e-4f;
  EXPECT_FALSE(frames(1));
  EXPECT_TRUE(frames(8));
  scene.sun.irradiance.x += 0.1f;
  EXPECT_FALSE(frames(1));
  EXPECT_TRUE(frames(8));
  methods::settings(scene).method = "none";
  EXPECT_FALSE(frames(1));
}

/// A board that stands on the ground, whose only target lays its upper edge down to the east within a second.
std::shared_ptr<scene::Model> falling_board() {
  auto model = model_of(quad({0, 0, 0}, {0, 2, 0}, {0, 2, 3}, {0, 0, 3}), matt({0.7f, 0.2f, 0.1f}));
  model->materials[0].is_double_sided = true;
  scene::Part& part = model->parts[0];
  scene::Deformation falls;
  falls.positions = part.mesh.positions;
  falls.normals = part.mesh.normals;
  falls.targets.push_back({{{0, 0, 0}, {0, 0, 0}, {3, 0, -2.9f}, {3, 0, -2.9f}}, {}});
  falls.weights = {0.0f};
  falls.weights_node = 0;
  part.deformation = std::make_shared<const scene::Deformation>(falls);
  model->animations.push_back({"fall", {}, {{0, scene::Interpolation::linear, {0, 1}, {{0}, {1}}}}, 1.0f});
  return model;
}

TEST_F(StageTest, WhatTheDriverRefusesIsAnError) {
  const Result<std::unique_ptr<Stage>> stage =
      Stage::create(make_simulation(rooms::all_registries(), scene::Scene()));
  ASSERT_TRUE(stage) << to_string(stage.errors());
  gl::Texture texture = gl::Texture::create(GLenum(GL_TEXTURE_2D));
  glTextureStorage2D(texture.name(), 1, GL_RGBA8, 1 << 30, 1);
  methods::Settings none;
  none.method = "none";
  const Status status = (*stage)->set_reflection(none);
  ASSERT_FALSE(status);
  EXPECT_NE(to_string(status.errors()).find("the graphics driver refuses"), std::string::npos);
  EXPECT_TRUE((*stage)->set_reflection(none)) << "it is reported once";
}

TEST_F(StageTest, WhatBendsIsWhereTheRayTracerSeesIt) {
  constexpr int width = 240, height = 160;
  scene::Scene place;
  add(place, model_of(ground(40), matt(glm::vec3(0.25f))));
  scene::play(place.objects[std::size_t(add(place, falling_board()))], {.animation = 0});
  place.sun.direction_to_sun = glm::normalize(glm::vec3(-0.6f, -0.4f, 0.7f));
  Result<std::unique_ptr<Stage>> stage =
      Stage::create(make_simulation(rooms::all_registries(), std::move(place)));
  ASSERT_TRUE(stage) << to_string(stage.errors());
  Camera camera;
  camera.world_from_camera = look_at({1.5f, -9, 2}, {1.5f, 0, 1.2f});
  camera.vertical_fov = glm::radians(40.0f);
  Image8 before;
  for (const double step_s : {0.0, 0.6}) {
    ASSERT_TRUE((*stage)->simulation().advance(step_s).empty());
    (*stage)->draw(camera, width, height);
    const Image8 drawn = (*stage)->picture();
    const reference::TracedPicture truth = (*stage)->trace(camera, width, height, 16);
    const auto difference =
        reference::compare(drawn, shading::tone_mapped_picture(truth.radiance, (*stage)->scene().exposure));
    ASSERT_TRUE(difference) << to_string(difference.errors());
    EXPECT_LT(difference->flip, 0.02) << "after " << step_s << " s";  // edges alone differ
    EXPECT_NE(drawn.pixels, before.pixels);
    before = drawn;
  }
}

}  // namespace
}  // namespace parvis::stage
