// A second drawable beside the scene's: textured quads with holes, in every kind of view. (In curved mirrors
// and against the ray tracer: reflections/virtual_objects/drawables_test.cpp; in reference maps:
// reflections/reference_maps/map_cache_test.cpp.)
#include "graphics/render/drawable.h"

#include <gtest/gtest.h>

#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/renderer.h"
#include "graphics/render/test_quads.h"
#include "reflections/methods/cube_map.h"
#include "scene/data/test_scene.h"

namespace parvis::render {
namespace {

using scene::add, scene::box, scene::ground, scene::matt, scene::model_of;

constexpr int drawn_width = 200, drawn_height = 200;

/// Upright, 4 m wide, seen from the south.
TestQuad upright(glm::vec3 centre, bool is_dynamic = false) {
  const glm::mat4 world_from_quad(glm::vec4(2, 0, 0, 0), glm::vec4(0, 0, 2, 0), glm::vec4(0, -1, 0, 0),
                                  glm::vec4(centre, 1));
  return {world_from_quad, is_dynamic, true};
}

TestQuad level(glm::vec3 centre, bool is_dynamic = false) {
  return {glm::scale(glm::translate(glm::mat4(1.0f), centre), {2, 2, 1}), is_dynamic, true};
}

/// A wide plain, the quads of a test, and a camera that looks along +y from 10 m before the origin: there 20
/// m fill the picture.
class DrawableTest : public gl::ContextTest {
 protected:
  DrawableTest() {
    camera_.world_from_camera = look_at({0, -10, 3}, {0, 0, 3});
    camera_.vertical_fov = 0.5f * 3.14159265f;
    scene_.sun.direction_to_sun = {0, 0, 1};
    add(scene_, model_of(ground(60), matt(glm::vec3(0.5f))));
  }
  void make_renderer() {
    drawables_.add(test_quads_kind(quads_));
    drawables_.attach(scene_);
    renderer_ = fresh_renderer();
  }
  std::unique_ptr<Renderer> fresh_renderer() const {
    Result<std::unique_ptr<Renderer>> made = Renderer::create(scene_, drawables_, light::sun_and_sky);
    EXPECT_TRUE(made) << to_string(made.errors());
    return *std::move(made);
  }
  static ImageF draw(Renderer& renderer, const scene::Scene& scene, const Camera& camera) {
    renderer.begin_frame(scene, camera);
    renderer.prepare_main_view(camera, drawn_width, drawn_height);
    renderer.draw_main_view();
    return renderer.read_radiance();
  }
  ImageF draw() { return draw(*renderer_, scene_, camera_); }
  ObjectPicture pick() { return renderer_->pick(camera_, drawn_width, drawn_height, true); }
  static glm::vec3 at(const ImageF& image, int x, int y) {
    return {image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]};
  }
  void TearDown() override { renderer_.reset(); }

  scene::Scene scene_;
  Camera camera_;
  TestQuads quads_;
  Drawables drawables_;
  std::unique_ptr<Renderer> renderer_;
};

TEST_F(DrawableTest, TheMainViewShowsItWithItsHoles) {
  quads_ = {upright({0, 0, 3})};
  make_renderer();
  const ImageF with = draw();
  quads_[0].is_visible = false;
  const ImageF without = draw();
  // 10 pixels per metre: 40 x 40 pixels about the middle, of which the corners' quarters are holes.
  for (int y = 0; y < drawn_height; y += 3)
    for (int x = 0; x < drawn_width; x += 3) {
      const int from_left = x - 80, from_top = y - 80;
      const auto is_inner = [](int from) { return from > 11 && from < 28; };
      const auto is_outside = [](int from) { return from < -1 || from > 40; };
      const bool is_hole = (from_left < 9 || from_left > 30) && (from_top < 9 || from_top > 30);
      const bool is_same = at(with, x, y) == at(without, x, y);
      if (is_outside(from_left) || is_outside(from_top) || is_hole) {
        EXPECT_TRUE(is_same) << x << ", " << y;
      } else if ((is_inner(from_left) && from_top > 1 && from_top < 38) ||
                 (is_inner(from_top) && from_left > 1 && from_left < 38)) {
        EXPECT_FALSE(is_same) << x << ", " << y;
      }
    }
}

TEST_F(DrawableTest, ItsRadianceDependsOnTheViewer) {
  scene_.sun.irradiance = glm::vec3(0.0f);
  scene_.sky.picture = ImageF(16, 8, 3, 0.0f);
  quads_ = {upright({0, 0, 3})};
  make_renderer();
  for (const glm::vec3 eye : {glm::vec3(6, -8, 3), glm::vec3(-6, -8, 3), glm::vec3(0, -6, 11)}) {
    camera_.world_from_camera = look_at(eye, {0, 0, 3});
    const glm::vec3 expected = test_quads_shared::emission_toward(glm::normalize(eye - glm::vec3(0, 0, 3)));
    EXPECT_LT(glm::distance(at(draw(), drawn_width / 2, drawn_height / 2), expected), 0.02f);
  }
}

TEST_F(DrawableTest, PickingGivesItsNumberBehindTheObjects) {
  quads_ = {upright({-5, 0, 3}), upright({5, 0, 3}, true)};
  make_renderer();
  draw();
  const ObjectPicture objects = pick();
  const std::uint32_t first = std::uint32_t(scene_.objects.size()) + 1;
  EXPECT_EQ(*objects.at(50, 100), first);
  EXPECT_EQ(*objects.at(150, 100), first + 1);
  EXPECT_EQ(*objects.at(100, 150), 1u) << "the ground";
  EXPECT_EQ(*objects.at(132, 82), 0u) << "a hole before the sky";
}

TEST_F(DrawableTest, WhatNoPixelShowsIsCulled) {
  add(scene_, model_of(box({-8, 4, 0}, {8, 5, 9}), matt(glm::vec3(0.5f))));
  quads_ = {upright({0, 0, 3}), upright({0, 9, 3}), upright({0, -30, 3}), upright({90, 0, 3})};
  Result<std::unique_ptr<Drawable>> made = TestQuadDrawable::create(quads_, int(scene_.objects.size()));
  ASSERT_TRUE(made) << to_string(made.errors());
  auto& quads = dynamic_cast<TestQuadDrawable&>(**made);
  renderer_ = fresh_renderer();
  renderer_->add(&quads);
  draw();
  EXPECT_EQ(quads.drawn(), std::vector<std::size_t>{0}) << "behind the wall, behind the eye, beside the view";
  for (TestQuad& quad : quads_) quad.is_visible = false;
  quads_[1].is_visible = true;
  scene_.objects.back().is_visible = false;
  draw();
  EXPECT_EQ(quads.drawn(), std::vector<std::size_t>{1}) << "the wall has gone";
}

/// Straight down on the plain, 10 pixels per metre; a level quad 3 m above it, the sun in the zenith.
class DrawableShadowTest : public DrawableTest {
 protected:
  DrawableShadowTest() {
    camera_.world_from_camera = look_at({0, 0, 2}, {0, 0, 0}, {0, 1, 0});
    camera_.vertical_fov = 2.0f * std::atan(5.0f);
    scene_.sky.picture = ImageF(16, 8, 3, 0.02f);
  }
  float light_at(const ImageF& image, float east_m, float north_m) const {
    return at(image, int((east_m + 10) * 10.0f), int((10 - north_m) * 10.0f)).y;
  }
};

TEST_F(DrawableShadowTest, ItsHolesLetTheSunThrough) {
  quads_ = {level({0, 0, 3})};
  make_renderer();
  const ImageF light = draw();
  const float open = light_at(light, 4, 4);
  EXPECT_LT(light_at(light, 0.3f, 0.3f), 0.3f * open);
  EXPECT_LT(light_at(light, 1.6f, 0), 0.3f * open);
  for (const float east : {-1.6f, 1.6f})
    for (const float north : {-1.6f, 1.6f}) EXPECT_GT(light_at(light, east, north), 0.9f * open);
}

TEST_F(DrawableShadowTest, AMovingShadowGoesWithIt) {
  quads_ = {level({-4, 0, 3}, true)};
  make_renderer();
  ImageF light = draw();
  EXPECT_LT(light_at(light, -4, 0), 0.3f * light_at(light, 4, 0));
  quads_[0] = level({4, 0, 3}, true);
  light = draw();
  EXPECT_LT(light_at(light, 4, 0), 0.3f * light_at(light, -4, 0));
  renderer_->begin_still_frame(scene_, camera_);
  renderer_->prepare_main_view(camera_, drawn_width, drawn_height, Subjects::fixed);
  renderer_->draw_main_view();
  light = renderer_->read_radiance();
  EXPECT_GT(light_at(light, 4, 0), 0.9f * light_at(light, -4, 0)) << "static surroundings alone";
}

/// A renderer that saw the change gives the picture of one that was made after it.
TEST_F(DrawableShadowTest, StaticOnesMayVanishAppearAndMove) {
  quads_ = {level({-4, 0, 3}), level({4, 2, 3})};
  make_renderer();
  const ImageF at_first = draw();
  const int changes = renderer_->fixed_changes();
  draw();
  EXPECT_EQ(renderer_->fixed_changes(), changes) << "nothing new";
  const auto expect_as_new = [&](const char* what) {
    const ImageF changed = draw();
    EXPECT_NE(changed.pixels, at_first.pixels) << what;
    const auto fresh = fresh_renderer();
    EXPECT_EQ(changed.pixels, draw(*fresh, scene_, camera_).pixels) << what;
  };
  quads_[0].is_visible = false;
  expect_as_new("one vanishes");
  quads_[0] = level({-5, -3, 3});
  expect_as_new("and appears elsewhere");
  EXPECT_GT(renderer_->fixed_changes(), changes);
}

TEST_F(DrawableTest, CubeFacesShowIt) {
  scene_.sun.irradiance = glm::vec3(0.0f);
  scene_.sky.picture = ImageF(16, 8, 3, 0.0f);
  quads_ = {upright({0, 4, 3}), upright({0, -4, 3}, true)};
  make_renderer();
  renderer_->begin_frame(scene_, camera_);
  constexpr int resolution = 32;
  methods::CubeMap map(resolution);
  const glm::vec3 centre(0.3f, 0, 3);
  const auto middle_of = [&](int face, Subjects subjects, const std::vector<std::uint8_t>* shown = nullptr) {
    map.draw_face(*renderer_, face, centre, -1, subjects, shown);
    std::vector<glm::vec4> texels(6 * resolution * resolution);
    glGetTextureImage(map.texture(), 0, GL_RGBA, GL_FLOAT, GLsizei(texels.size() * sizeof(glm::vec4)),
                      texels.data());
    return glm::vec3(texels[std::size_t((face * resolution + resolution / 2) * resolution + resolution / 2)]);
  };
  constexpr int north = 2, south = 3;
  const auto shown_from = [&](glm::vec3 point) {
    return test_quads_shared::emission_toward(glm::normalize(centre - point));
  };
  const glm::vec3 static_one = shown_from({0.3f, 4, 3}), moving_one = shown_from({0.3f, -4, 3});
  EXPECT_LT(glm::distance(middle_of(north, Subjects::all), static_one), 0.03f);
  EXPECT_LT(glm::distance(middle_of(south, Subjects::all), moving_one), 0.03f);
  EXPECT_LT(glm::distance(middle_of(north, Subjects::fixed), static_one), 0.03f);
  EXPECT_LT(glm::length(middle_of(south, Subjects::fixed)), 0.03f)
      << "dynamic objects are not in reference maps";
  EXPECT_LT(glm::length(middle_of(north, Subjects::moving)), 0.03f);
  const std::vector<std::uint8_t> the_second{1, 0, 1}, objects_alone{1};
  EXPECT_LT(glm::length(middle_of(north, Subjects::all, &the_second)), 0.03f);
  EXPECT_LT(glm::distance(middle_of(south, Subjects::all, &the_second), moving_one), 0.03f);
  EXPECT_LT(glm::length(middle_of(north, Subjects::all, &objects_alone)), 0.03f);
}

TEST_F(DrawableTest, AKindThatNothingDrawsIsAnError) {
  quads_ = {upright({0, 0, 3})};
  drawables_.add(test_quads_kind(quads_));
  drawables_.attach(scene_);
  const Result<std::unique_ptr<Renderer>> made = Renderer::create(scene_, {}, light::sun_and_sky);
  ASSERT_FALSE(made);
  EXPECT_NE(to_string(made.errors()).find("test quads"), std::string::npos) << to_string(made.errors());
}

/// Something with three levels of quality, which shows nothing.
struct Wishful final : Drawable {
  Extents extents() const override { return {}; }
  std::span<QualityWish> quality_wishes(const View& view, const Culling&) override {
    EXPECT_EQ(view.kind, ViewKind::main);
    return {&wish, 1};
  }
  void prepare(const View&, const Culling&) override { prepared_with = wish.level; }
  void draw(const View&, Pass) override {}

  std::array<QualityLevel, 3> levels{{{1.0, 1.0}, {4.0, 2.0}, {20.0, 3.0}}};
  QualityWish wish{1.0f, levels, 0};
  int prepared_with = -1;
};

TEST_F(DrawableTest, LevelsOfDetailShareOneBudget) {
  renderer_ = fresh_renderer();
  Wishful large, small;
  large.wish.importance = 10.0f;
  renderer_->add(&large);
  renderer_->add(&small);
  draw();
  EXPECT_EQ(large.prepared_with, 2) << "no budget: the best";
  EXPECT_EQ(small.prepared_with, 2);
  renderer_->set_budget(25.0);
  draw();
  EXPECT_EQ(large.prepared_with, 2);
  EXPECT_EQ(small.prepared_with, 1) << "what is left of 25 ms";
  renderer_->set_budget(6.0);
  draw();
  EXPECT_EQ(large.prepared_with, 1);
  EXPECT_EQ(small.prepared_with, 0);
}

}  // namespace
}  // namespace parvis::render
