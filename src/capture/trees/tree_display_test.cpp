// Captured trees in scenes: their pictures against what rays see, shadows, picking, levels of detail, the
// node.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "base/registries.h"
#include "capture/trees/billboard_textures.h"
#include "capture/trees/cell_order.h"
#include "capture/trees/judge.h"
#include "capture/trees/level_choice.h"
#include "capture/trees/scene_tree.h"
#include "capture/trees/shown_tree.h"
#include "capture/trees/test_volume.h"
#include "capture/trees/tree_drawable.h"
#include "capture/trees/tree_file.h"
#include "capture/trees/wind.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/metrics.h"
#include "graphics/reference/tracer.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/renderer.h"
#include "graphics/shading/tone_curve.h"
#include "room_list.h"
#include "scene/data/sun_shadows.h"
#include "scene/data/test_scene.h"
#include "scene/script/scene_loader.h"

namespace parvis::trees {
namespace {

using scene::add, scene::ground, scene::matt, scene::model_of;

/// A ball of 1 m round (0, 0, 1) whose colour changes with height, photographed from 12 places.
const BillboardTree& ball_tree() {
  static const BillboardTree tree = [] {
    const TestVolume ball(27, 0.3f, 20.0f);
    TreeVolume volume{ball.grid, ball.extinction_per_m, {}};
    for (std::size_t i = 0; i < volume.grid.size(); ++i) {
      const float height = volume.grid.centre(i).z - 0.5f;
      volume.colour.emplace_back(0.15f + 0.65f * height, 0.7f,
                                 0.2f);  // none below the highlight, foliage.glsl
    }
    std::vector<TreeView> views = ball.ring(12, 96);
    for (TreeView& view : views) view.picture = photograph_of(render_volume(volume, view.camera));
    TextureOptions options;
    options.parent_levels = 0;
    return textured(volume, views, options);
  }();
  return tree;
}

std::shared_ptr<const TreeLevels> ball_levels() {
  static const auto levels = std::make_shared<const TreeLevels>(levels_of(ball_tree()));
  return levels;
}

/// A tree on a plain, 4 m tall, and a camera 12 m south of it.
class TreeDisplayTest : public gl::ContextTest {
 protected:
  static constexpr int width = 160, height = 160;

  TreeDisplayTest() {
    camera_.world_from_camera = look_at({0, -12, 3}, {0, 0, 2});
    camera_.vertical_fov = 0.6f;
    scene_.sun.direction_to_sun = glm::normalize(glm::vec3(0.6f, -0.5f, 0.7f));
    add(scene_, model_of(ground(40), matt(glm::vec3(0.5f))));
    drawables_.add(scene_trees_kind());
    drawables_.attach(scene_);
  }
  void plant(glm::vec3 foot, float scale = 4.0f) {
    SceneTree tree;
    tree.tree = ball_levels();
    tree.world_from_tree = glm::translate(glm::scale(glm::translate(glm::mat4(1.0f), foot), glm::vec3(scale)),
                                          glm::vec3(0, 0, -0.5f));
    scene_.data<SceneTrees>().add(tree, int(scene_trees(scene_).size()));
  }
  std::unique_ptr<render::Renderer> renderer() const {
    Result<std::unique_ptr<render::Renderer>> made =
        render::Renderer::create(scene_, drawables_, light::sun_and_sky);
    EXPECT_TRUE(made) << to_string(made.errors());
    return *std::move(made);
  }
  Image8 drawn(render::Renderer& renderer) const {
    EXPECT_TRUE(render::draw_frame(renderer, scene_, {camera_, width, height}));
    return shading::tone_mapped_picture(renderer.read_radiance(), 1.0f);
  }
  Image8 traced(render::Renderer& renderer, int samples) const {
    renderer.begin_frame(scene_, camera_);
    const shading::DrawnLight light = renderer.drawn_light();
    reference::TraceOptions options;
    options.samples_per_pixel = samples;
    options.drawn_light = &light;
    const reference::RayScene rays(scene_);
    return shading::tone_mapped_picture(
        reference::trace_picture(rays, scene_, renderer.sky(), camera_, width, height, options).radiance,
        1.0f);
  }
  static double flip(const Image8& a, const Image8& b) {
    const Result<reference::Difference> difference = reference::compare(a, b);
    EXPECT_TRUE(difference) << to_string(difference.errors());
    return difference->flip;
  }

  /// The difference of two pictures beside that of two others; green, of 255.
  struct Comparison {
    double mean, spread, correlation;
  };
  static Comparison compared(const Image8& a, const Image8& without_a, const Image8& b,
                             const Image8& without_b) {
    double sum = 0.0, aa = 0.0, bb = 0.0, ab = 0.0, count = 0.0;
    for (std::size_t i = 1; i < a.pixels.size(); i += std::size_t(a.channels), ++count) {
      const double of_a = double(a.pixels[i]) - double(without_a.pixels[i]),
                   of_b = double(b.pixels[i]) - double(without_b.pixels[i]);
      sum += of_a, aa += of_a * of_a, bb += of_b * of_b, ab += of_a * of_b;
    }
    return {sum / count, std::sqrt(aa / count), ab / std::sqrt(aa * bb)};
  }

  scene::Scene scene_;
  Camera camera_;
  render::Drawables drawables_;
};

TEST_F(TreeDisplayTest, ItsPictureIsWhatRaysSee) {
  plant({-1, 0, 0}), plant({1.6f, 3, 0}, 3.0f);
  const auto with = renderer();
  const Image8 picture = drawn(*with);
  // Light is looked up where the eye's billboards stand, and where rays enter the cells: half a cell apart.
  // Crowns are drawn with each cell's mean share of the sun, where rays find leaf by leaf what the map, or
  // with exact shadows another leaf (0.060), hides: that is most of the 0.055 measured, and cancels in the
  // mean.
  const Image8 truth = traced(*with, 64);
  const double difference = flip(picture, truth);
  EXPECT_LT(difference, 0.06);
  const auto mean_of_crown = [](const Image8& image) {
    glm::dvec3 sum(0.0);
    for (int v = 45; v < 105; ++v)
      for (int u = 25; u < 85; ++u)
        for (int c = 0; c < 3; ++c) sum[c] += image.at(u, v)[c] / 3600.0;
    return sum;
  };
  const glm::dvec3 off = glm::abs(mean_of_crown(picture) - mean_of_crown(truth));
  EXPECT_LT(std::max({off.x, off.y, off.z}), 4.0) << "of 255";
  // The control: without the trees.
  scene_.data<SceneTrees>() = {};
  EXPECT_GT(flip(drawn(*renderer()), picture), 2.5 * difference);
}

TEST_F(TreeDisplayTest, CloserThanItsPhotographsItHasDetailAsRaysSeeIt) {
  plant({0, 0, 0});
  camera_.world_from_camera = look_at({0, -4.5f, 2}, {0, 0, 2});
  camera_.vertical_fov = 0.25f;  // pixels are a tenth as wide as those of the photographs
  const auto with = renderer();
  const Image8 picture = drawn(*with), rays = traced(*with, 64);
  auto plain = std::make_shared<TreeLevels>(*ball_levels());
  plain->detail = {};
  scene_.data<SceneTrees>().items[0].tree = plain;
  const auto without = renderer();
  const Image8 blurred = drawn(*without), blurred_rays = traced(*without, 64);
  const Comparison detail = compared(picture, blurred, rays, blurred_rays);
  EXPECT_GT(detail.spread, 5.0) << "of 255";
  EXPECT_GT(detail.correlation, 0.5);
  EXPECT_LT(std::abs(detail.mean), 3.0) << "of 255: it changes nothing in the mean";

  // From where the photographs were taken, and farther away, there is none.
  camera_.world_from_camera = look_at({0, -36, 2}, {0, 0, 2});
  camera_.vertical_fov = 0.3f;
  const Image8 far_without = drawn(*without);
  scene_.data<SceneTrees>().items[0].tree = ball_levels();
  EXPECT_EQ(drawn(*with).pixels, far_without.pixels);
}

TEST_F(TreeDisplayTest, InTheLightOfItsPhotographsItLooksAsInThem) {
  const CapturedLight& light = ball_levels()->levels.front().light;
  const TreeView view = TestVolume(3).view(0.3f, 1.2f, 240);  // of the finest level
  auto plain = std::make_shared<TreeLevels>(*ball_levels());
  plain->detail = {};  // the view is closer than the photographs
  const auto error = [&](const scene::Scene& scene) {
    Result<ShownTree> shown = ShownTree::create(plain, scene);
    EXPECT_TRUE(shown) << to_string(shown.errors());
    const Result<ImageF> picture = shown->picture(view.camera);
    EXPECT_TRUE(picture) << to_string(picture.errors());
    return flip(over_white(*picture), over_white(render_billboards(ball_tree(), view.camera)));
  };
  const double own = error(scene_in_light_of(light));
  // Measured 0.031. The ball's light is nearly all sky, of whose highlight foliage.glsl takes too little off:
  // with 0.0145 in place of 0.0125, which is between those of sun and sky, it is 0.0285.
  EXPECT_LT(own, 0.035);
  // The control: the sun on the other side.
  scene::Scene turned = scene_in_light_of(light);
  turned.sun.irradiance = glm::vec3(3.0f);
  turned.sun.direction_to_sun = glm::normalize(glm::vec3(0.9f, 0.0f, 0.4f));
  EXPECT_GT(error(turned), 2.0 * own);
}

TEST_F(TreeDisplayTest, ItStandsInTheShadowOfOthersAndNotTwiceInItsOwn) {
  // Light from the east; a wall east of the tree, out of the picture.
  scene_.sun.direction_to_sun = glm::normalize(glm::vec3(1.0f, 0.0f, 0.8f));
  plant({0, 0, 0});
  const Image8 open = drawn(*renderer());
  add(scene_, model_of(ground(12), matt(glm::vec3(0.5f))), false,
      glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(8, 0, 6)), 1.5707963f, glm::vec3(0, 1, 0)));
  const Image8 shaded = drawn(*renderer());
  const auto mean = [](const Image8& image) {
    double sum = 0.0;
    for (int v = -6; v <= 6; ++v)
      for (int u = -6; u <= 6; ++u) sum += image.at(width / 2 + u, height / 2 - 15 + v)[1] / 169.0;
    return sum;
  };
  EXPECT_LT(mean(shaded), 0.85 * mean(open));
}

TEST_F(TreeDisplayTest, PickingGivesItsThing) {
  plant({-1.5f, 0, 0}, 2.0f), plant({1.5f, 0, 0}, 2.0f);
  const auto made = renderer();
  made->begin_frame(scene_, camera_);
  const render::ObjectPicture picked = made->pick(camera_, width, height, true);
  const reference::ObjectPicture rays =
      reference::trace_objects(reference::RayScene(scene_), camera_, width, height);
  const auto count = [](const auto& picture, std::uint32_t number) {
    return std::ranges::count(picture.pixels, number);
  };
  for (const std::uint32_t number : {2u, 3u}) {
    EXPECT_GT(count(picked, number), 300);
    EXPECT_NEAR(double(count(picked, number)), double(count(rays, number)),
                0.1 * double(count(rays, number)));
  }
}

TEST_F(TreeDisplayTest, ItsShadowHasTheDensityOfItsCrown) {
  camera_.world_from_camera = look_at({0, 0, 30}, {0, 0, 0}, {0, 1, 0});
  scene_.sun.direction_to_sun = glm::normalize(glm::vec3(1, 0, 1));
  const Image8 open = drawn(*renderer());
  plant({0, 0, 0});
  const Image8 shaded = drawn(*renderer());
  // The crown's middle is 2 m high: its shadow lies 2 m to the west; 8.9 pixels per metre.
  const auto mean = [](const Image8& image, int x) {
    double sum = 0.0;
    for (int v = -4; v <= 4; ++v)
      for (int u = -4; u <= 4; ++u) sum += image.at(x + u, height / 2 + v)[1] / 81.0;
    return sum;
  };
  EXPECT_LT(mean(shaded, width / 2 - 30), 0.8 * mean(open, width / 2 - 30));
  EXPECT_NEAR(mean(shaded, width / 2 + 60), mean(open, width / 2 + 60), 1.0) << "toward the sun";
  scene_.data<scene::SunShadows>().caster_nodes = {{1, 1}};  // it is of node 0
  const auto alone = renderer();
  EXPECT_NEAR(mean(drawn(*alone), width / 2 - 30), mean(open, width / 2 - 30), 1.0)
      << "where others alone cast shadows";
}

TEST_F(TreeDisplayTest, ATreeThatSwaysIsDrawnAsRaysSeeIt) {
  plant({0, 0, 0});
  SceneTree& tree = scene_.data<SceneTrees>().items.front();
  tree.sway_m = 1.0f;
  const auto with = renderer();
  action::SharedByProcesses shared;
  WindProcess wind;
  wind.begin(scene_, shared);
  const Image8 first = drawn(*with);
  for (int i = 0; i < 45; ++i) wind.step(scene_);
  wind.present(scene_, 0.0);
  EXPECT_EQ(wind.status(), "1 trees sway");
  const Image8 later = drawn(*with);
  const glm::mat4 leaning = tree.world_from_leaning_tree();
  const glm::vec4 foot(ball_levels()->foot, 1.0f),
      top(ball_levels()->foot.x, ball_levels()->foot.y, ball_levels()->box.max.z, 1.0f);
  EXPECT_LT(glm::length(leaning * foot - tree.world_from_tree * foot), 1e-4f);
  EXPECT_GT(glm::length(leaning * top - tree.world_from_tree * top), 0.1f);
  EXPECT_LE(glm::length(leaning * top - tree.world_from_tree * top), 1.0f);
  const double moved = flip(first, later), wrong = flip(later, traced(*with, 64));
  EXPECT_LT(wrong, 0.06);
  // The control: rays that see it as it stood before.
  const Image8 sways = later;
  tree.lean_m = glm::vec2(0.0f);
  EXPECT_GT(flip(sways, traced(*with, 64)), 1.1 * wrong);
  EXPECT_GT(moved, 0.01);
}

TEST(Wind, IsContinuousAndBounded) {
  for (int i = 0; i < 2000; ++i) {
    const double time_s = 0.05 * i;
    EXPECT_LE(glm::length(lean_at(time_s, 0.4f)), 1.0f);
    EXPECT_LT(glm::distance(lean_at(time_s, 0.4f), lean_at(time_s + 1.0 / 60.0, 0.4f)), 0.05f);
  }
  EXPECT_GT(glm::distance(lean_at(3.0, 0.0f), lean_at(3.0, 2.0f)), 0.05f) << "each in its own time";
}

TEST_F(TreeDisplayTest, HiddenAndPlantedTreesChangeThePicture) {
  plant({-1, 0, 0});
  const auto kept = renderer();
  const Image8 before = drawn(*kept);
  scene_.data<SceneTrees>().items[0].is_visible = false;
  const Image8 hidden = drawn(*kept);
  EXPECT_EQ(hidden.pixels, drawn(*renderer()).pixels);
  EXPECT_NE(hidden.pixels, before.pixels);
  scene_.data<SceneTrees>().items[0].is_visible = true;
  EXPECT_EQ(drawn(*kept).pixels, before.pixels);
}

TEST(TreeLevels, EachShowsTheSameTreeWithFewerBillboards) {
  const TreeLevels& tree = *ball_levels();
  ASSERT_EQ(tree.levels.size(), 4u);
  EXPECT_EQ(tree.levels.back().grid.size(), 1u);
  const TreeView view = TestVolume(3).view(0.3f, 1.2f, 24);
  const ImageF finest = render_billboards(tree.levels[0], view.camera);
  for (std::size_t level = 1; level < tree.levels.size(); ++level) {
    EXPECT_LT(3 * tree.levels[level].grid.size(), tree.levels[level - 1].grid.size());
    const ImageF coarse = render_billboards(tree.levels[level], view.camera);
    double sum = 0.0, error = 0.0;
    for (std::size_t i = 3; i < coarse.pixels.size(); i += 4)
      sum += finest.pixels[i], error += std::abs(coarse.pixels[i] - finest.pixels[i]);
    EXPECT_LT(error, 0.2 * sum) << "level " << level;
  }
}

TEST(TreeLevels, AreChosenByPixels) {
  const TreeLevels& tree = *ball_levels();
  const DetailLimits limits{1.0f, 3.0f};
  EXPECT_EQ(level_for(tree, {1e6f, 0.1f}, limits), 0u);
  EXPECT_EQ(level_for(tree, {std::numeric_limits<float>::infinity(), 0.0f}, limits), 0u)
      << "the eye is in it";
  EXPECT_EQ(level_for(tree, {1.0f, 0.2f}, limits), tree.levels.size() - 1);
  EXPECT_EQ(level_for(tree, {1.0f, 0.2f}, {0.0f, 0.0f}), 0u);
  for (const float parallax : {0.0f, 0.1f, 1.0f}) {
    std::size_t last = tree.levels.size() - 1;
    for (float pixels_per_metre = 1.0f; pixels_per_metre < 1e4f; pixels_per_metre *= 1.3f) {
      const std::size_t level = level_for(tree, {pixels_per_metre, parallax}, limits);
      EXPECT_LE(level, last) << "nearer is never coarser";
      EXPECT_LE(level, level_for(tree, {pixels_per_metre, 0.5f * parallax}, limits))
          << "a photograph from nearby allows coarser levels";
      last = level;
      if (level == 0) continue;
      if (texel_size_m(tree.levels[level]) > 1.01f * texel_size_m(tree.levels[0])) {
        EXPECT_LE(texel_size_m(tree.levels[level]) * pixels_per_metre, limits.max_texel_pixels);
      }
      const float cell_pixels = tree.levels[level].grid.cell_size_m().x * pixels_per_metre;
      EXPECT_LE(0.5f * cell_pixels * parallax, limits.max_shift_pixels + 1e-3f);
    }
  }
}

TEST(TreeLevels, TreesInFrontAreFinerWhileAViewAffordsIt) {
  const TreeLevels& tree = *ball_levels();
  TreeDetail detail;
  const SeenTree seen{0.8f / texel_size_m(tree.levels[0]), 0.0f};  // from a photograph's place
  const std::size_t usual = level_for(tree, seen, detail.limits);
  ASSERT_EQ(level_for(tree, seen, detail.finer_limits), 0u)
      << "texels of .8 pixels are not to be drawn again";
  ASSERT_GT(usual, 0u);
  const std::vector<TreeInView> three(3, TreeInView{&tree, seen});
  const std::size_t fine = tree.levels[0].grid.size(), coarse = tree.levels[usual].grid.size();
  using Levels = std::vector<std::size_t>;
  EXPECT_EQ(levels_in_view(three, detail), (Levels{0, 0, 0}));
  detail.affordable_billboards = fine + 2 * coarse;
  EXPECT_EQ(levels_in_view(three, detail), (Levels{0, usual, usual})) << "the first in front";
  --detail.affordable_billboards;
  EXPECT_EQ(levels_in_view(three, detail), (Levels{usual, usual, usual}));
  // As small as this there is nothing that a finer level would show.
  const SeenTree small{0.1f / texel_size_m(tree.levels[0]), 0.0f};
  EXPECT_EQ(levels_in_view(std::vector<TreeInView>{{&tree, small}}, TreeDetail()),
            Levels{level_for(tree, small, TreeDetail().finer_limits)});
  EXPECT_GT(level_for(tree, small, TreeDetail().finer_limits), 0u);
}

TEST(TreeLevels, ParallaxIsNoneAtAPhotographAndAllFromAbove) {
  const BillboardTree& tree = ball_tree();
  const glm::vec3 middle = tree.grid.box().centre(), camera = tree.views[0].camera.position_in_world,
                  next = tree.views[1].camera.position_in_world;
  EXPECT_LT(parallax(tree, camera), 1e-3f);
  EXPECT_GT(parallax(tree, middle + 0.5f * (camera - middle)), 0.05f) << "another perspective";
  const glm::vec3 between =
      middle + glm::length(camera - middle) *
                   glm::normalize(glm::normalize(camera - middle) + glm::normalize(next - middle));
  const float half_angle =
      0.5f * std::acos(glm::dot(glm::normalize(camera - middle), glm::normalize(next - middle)));
  EXPECT_NEAR(parallax(tree, between), std::sin(half_angle), 0.02f);
  EXPECT_GT(parallax(tree, middle + glm::vec3(0, 0, glm::length(camera - middle))), 0.8f);
}

TEST_F(TreeDisplayTest, FarTreesAreAHandfulOfBillboards) {
  plant({0, 0, 0});
  const SceneTree& tree = scene_trees(scene_)[0];
  const Bounds bounds = transformed(tree.world_from_tree, tree.tree->box);
  std::size_t last = tree.tree->levels.front().grid.size();
  bool has_a_level_between = false;
  for (float distance_m = 3.0f; distance_m < 400.0f; distance_m *= 1.25f) {
    camera_.world_from_camera = look_at({0.3f * distance_m, -distance_m, 3}, {0, 0, 2});
    const render::View view = render::camera_view(camera_, 0, 1280, 720);
    const SeenTree seen = seen_tree(tree, bounds, view, render::Culling(view, nullptr));
    const std::size_t billboards = tree.tree->levels[level_for(*tree.tree, seen, DetailLimits())].grid.size();
    EXPECT_LE(billboards, last) << distance_m << " m";
    const float height_pixels = tree.tree->box.size().z * seen.pixels_per_metre;
    if (height_pixels < 20.0f) {
      EXPECT_LE(billboards, 8u) << distance_m << " m";
    }
    has_a_level_between |= billboards < tree.tree->levels.front().grid.size() && billboards > 1;
    last = billboards;
  }
  EXPECT_EQ(last, 1u);
  EXPECT_TRUE(has_a_level_between);
}

TEST_F(TreeDisplayTest, FarLevelsAreAsRaysSeeThem) {
  plant({-2, 0, 0}), plant({3, 4, 0}, 3.0f);
  camera_.world_from_camera = look_at({-10, -60, 8}, {0, 0, 2});
  camera_.vertical_fov = 0.2f;
  const auto kept = renderer();
  const auto drawn_with = [&](const DetailLimits& limits) {
    scene_.data<TreeDetail>().limits = limits, scene_.data<TreeDetail>().affordable_billboards = 0;
    return drawn(*kept);
  };
  const Image8 finest = drawn_with({0.0f, 0.0f}), shipped = drawn_with({}),
               coarsest = drawn_with({1e9f, 1e9f});
  EXPECT_NE(shipped.pixels, finest.pixels) << "no coarser level is used";
  const Image8 rays = traced(*kept, 64);
  const double of_finest = flip(finest, rays), of_shipped = flip(shipped, rays);
  EXPECT_LT(of_finest, 0.05);
  EXPECT_LT(of_shipped, 1.5 * of_finest) << flip(coarsest, rays);
  // The control: without the trees.
  scene_.data<SceneTrees>() = {};
  EXPECT_GT(flip(drawn(*renderer()), rays), 2.5 * of_shipped);
}

TEST_F(TreeDisplayTest, WhatCrownsHideIsNotMissed) {
  for (int i = 0; i < 6; ++i) plant({0.3f * float(i % 3), 4.5f * float(i), 0});
  const auto kept = renderer();
  const auto drawn_with = [&](float min_visible) {
    scene_.data<TreeDetail>().min_visible = min_visible;
    return drawn(*kept);
  };
  const Image8 all = drawn_with(0.0f), shipped = drawn_with(TreeDetail().min_visible);
  const double missed = flip(shipped, all);
  EXPECT_LT(missed, 0.01);
  // The controls: what is partly visible is left out, too.
  const double tenth = flip(drawn_with(0.1f), all);
  EXPECT_GT(tenth, missed) << "nothing is left out";
  EXPECT_GT(flip(drawn_with(0.5f), all), tenth);
}

TEST_F(TreeDisplayTest, ManyBillboardsAreBlendedByThemselvesAsInTheView) {
  for (int i = 0; i < 6; ++i) plant({0.3f * float(i % 3), 4.5f * float(i), 0});
  add(scene_, model_of(ground(1), matt(glm::vec3(0.5f))), false,  // a wall before them
      glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(-1.2f, -3, 2)), 1.5707963f, glm::vec3(1, 0, 0)));
  const auto kept = renderer();
  const auto drawn_with = [&](std::size_t direct_billboards) {
    scene_.data<TreeDetail>().direct_billboards = direct_billboards;
    return drawn(*kept);
  };
  const Image8 in_view = drawn_with(1'000'000), by_themselves = drawn_with(0);
  EXPECT_NE(by_themselves.pixels, in_view.pixels) << "the wall's edge has one sample per pixel";
  const double difference = flip(by_themselves, in_view);
  EXPECT_LT(difference, 0.01);
  EXPECT_EQ(drawn_with(1'000'000).pixels, in_view.pixels) << "a layer leaves no traces";
  // The control: without the trees.
  scene_.data<SceneTrees>() = {};
  EXPECT_GT(flip(drawn(*renderer()), in_view), 10.0 * difference);
}

TEST_F(TreeDisplayTest, FarLevelsCastTheShadowsOfTheFinest) {
  camera_.world_from_camera = look_at({0, 0, 30}, {0, 0, 0}, {0, 1, 0});
  scene_.sun.direction_to_sun = glm::normalize(glm::vec3(1, 0, 0.7f));
  plant({0, 0, 0}), plant({0, 5, 0}, 3.0f);
  const auto shaded_with = [&](const DetailLimits& limits) {
    scene_.data<TreeDetail>().limits = limits, scene_.data<TreeDetail>().affordable_billboards = 0;
    Image8 picture = drawn(*renderer());
    for (int y = 0; y < picture.height; ++y)  // the shadows alone, which lie to the west
      for (int x = width / 2 - 14; x < picture.width; ++x) std::fill_n(picture.at(x, y), picture.channels, 0);
    return picture;
  };
  const Image8 finest = shaded_with({0.0f, 0.0f});
  const double of_shipped = flip(shaded_with({}), finest);
  EXPECT_GT(of_shipped, 0.0) << "no coarser level is used";
  EXPECT_LT(of_shipped, 0.01);
  // The control: no shadows.
  scene_.data<SceneTrees>() = {};
  EXPECT_GT(flip(shaded_with({}), finest), 5.0 * of_shipped);
}

class TreeNodeTest : public testing::Test {
 protected:
  TreeNodeTest() {
    std::filesystem::create_directories(folder_);
    script::register_room(registries_), register_room(registries_);
  }
  Result<scene::LoadedScene> load(const std::string& script) const {
    std::ofstream(folder_ / "scene.xp") << script;
    return scene::load_scene(folder_ / "scene.xp", registries_.get<scene::NodeRegistry>(), {});
  }

  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "parvis_tree_node";
  Registries registries_;
};

TEST_F(TreeNodeTest, ItsFootStandsWhereTheNodeSays) {
  ASSERT_TRUE(write_tree(folder_ / "ball.tree", ball_tree()));
  const Result<scene::LoadedScene> loaded = load(
      "tree(file=\"ball.tree\", position=\"5 2 1\", height=8)\n"
      "group(position=\"1 0 0\") { tree(file=\"ball.tree\", visible=0) }\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  const std::vector<SceneTree>& trees = scene_trees(loaded->scene);
  ASSERT_EQ(trees.size(), 2u);
  EXPECT_EQ(trees[0].tree, trees[1].tree) << "one file, one tree";
  const glm::vec3 foot(trees[0].world_from_tree * glm::vec4(trees[0].tree->foot, 1.0f));
  EXPECT_LT(glm::distance(foot, glm::vec3(5, 2, 1)), 1e-4f);
  EXPECT_NEAR(transformed(trees[0].world_from_tree, trees[0].tree->box).max.z, 9.0f, 0.4f);
  EXPECT_FALSE(trees[1].is_visible);
}

TEST_F(TreeNodeTest, ItsTrunkIsAnObjectThatStandsAndLeansWithIt) {
  BillboardTree tree = ball_tree();
  tree.trunk = TrunkShape{{{{{0.1f, 0, 0.2f}, 0.1f}, {{0.1f, 0, 0.7f}, 0.08f}}}, Image8(8, 8, 4, 120)};
  ASSERT_TRUE(write_tree(folder_ / "trunk.tree", tree));
  Result<scene::LoadedScene> loaded =
      load("tree(file=\"trunk.tree\", position=\"5 2 1\", sway=0.5)\ntree(file=\"trunk.tree\")\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::Scene& scene = loaded->scene;
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].model, scene.objects[1].model) << "one file, one trunk";
  EXPECT_TRUE(scene.objects[0].is_dynamic);
  EXPECT_FALSE(scene.objects[1].is_dynamic);
  const glm::vec3 foot(scene.objects[0].world_from_model * glm::vec4(0.1f, 0, 0.2f, 1.0f));
  EXPECT_LT(glm::distance(foot, glm::vec3(5, 2, 1)), 1e-4f) << "the trunk stands at the position";

  action::SharedByProcesses shared;
  WindProcess wind;
  wind.begin(scene, shared);
  for (int i = 0; i < 45; ++i) wind.step(scene);
  wind.present(scene, 0.0);
  ASSERT_EQ(scene.objects[0].pose.size(), 1u);
  EXPECT_TRUE(scene.objects[1].pose.empty());
  const glm::vec4 top(0.1f, 0, 0.7f, 1.0f);
  const glm::mat4 leaning = scene_trees(scene)[0].world_from_leaning_tree();
  EXPECT_LT(glm::length(scene.objects[0].world_from_model * scene.objects[0].pose[0] * top - leaning * top),
            1e-4f);
  EXPECT_GT(glm::length(leaning * top - scene.objects[0].world_from_model * top), 0.01f);
}

TEST_F(TreeDisplayTest, ItsTrunkIsDrawnInTheLightOfTheScene) {
  BillboardTree tree = ball_tree();
  tree.light = {{0.0f, -0.8f, 0.6f}, 0.5f, 0.3f};
  const auto trunk_of = [&](std::uint8_t grey) {
    tree.trunk = TrunkShape{{{{{0, 0, -0.6f}, 0.2f}, {{0, 0, 0.6f}, 0.2f}}}, Image8(8, 8, 4, grey)};
    return levels_of(tree).trunk->textures.front().image;
  };
  const Image8 bright = trunk_of(120), dark = trunk_of(60);
  // Texture coordinate 3/4 is in the south, where the sun of the photographs is; 1/4 in the north.
  EXPECT_LT(bright.at(6, 4)[1] + 20, bright.at(2, 4)[1]) << "as bright in less light: a higher albedo";
  EXPECT_LT(dark.at(6, 4)[1] + 10, bright.at(6, 4)[1]);
}

TEST_F(TreeNodeTest, AGltfFileIsATreeAndMaySway) {
  ASSERT_TRUE(write_tree(folder_ / "ball.glb", ball_tree()));
  const Result<scene::LoadedScene> loaded = load("tree(file=\"ball.glb\", sway=0.3)\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  ASSERT_EQ(scene_trees(loaded->scene).size(), 1u);
  EXPECT_TRUE(scene_trees(loaded->scene)[0].sways());
}

TEST_F(TreeNodeTest, ABadFileIsAnErrorAtItsPlace) {
  std::ofstream(folder_ / "bad.tree") << "no tree";
  const Result<scene::LoadedScene> bad = load("\ntree(file=\"bad.tree\")\n");
  ASSERT_FALSE(bad);
  EXPECT_NE(to_string(bad.errors()).find("scene.xp:2:"), std::string::npos) << to_string(bad.errors());
  EXPECT_NE(to_string(bad.errors()).find("bad.tree"), std::string::npos);
  EXPECT_FALSE(load("tree(position=\"0 0 0\")\n")) << "no file";
}

}  // namespace
}  // namespace parvis::trees
