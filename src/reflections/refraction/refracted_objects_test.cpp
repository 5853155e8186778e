#include "reflections/refraction/refracted_objects.h"

#include "base/files.h"
#include "base/test_data.h"
#include "base/test_folder.h"
#include "graphics/gl/test_context.h"
#include "graphics/render/test_golden.h"
#include "reflections/methods/settings.h"
#include "reflections/reflector_maps/test_boxes.h"
#include "reflections/virtual_objects/virtual_objects.h"
#include "scene/data/glass_pieces.h"

namespace parvis::refraction {
using namespace reflection_search;
using namespace reflector_maps;
using namespace virtual_objects;
namespace {

scene::Material glass(float ior = 1.5f) {
  scene::Material material;
  material.ior = ior;
  material.roughness = 0.0f;
  material.is_mirror_like = true;
  return material;
}

enum class Shown { sky, objects };

Compared draw(scene::Scene scene, glm::vec3 eye, glm::vec3 target, Shown shown = Shown::objects) {
  if (shown == Shown::sky) methods::settings(scene).method = "rerendered_cube_map";  // and no map
  return draw_by(scene, eye, target, [](const scene::Scene& all, render::Renderer& renderer) {
    Result<std::unique_ptr<methods::Reflections>> mirrors = make_virtual_objects(all, renderer);
    if (!mirrors) return mirrors;
    return make_refracted_objects(all, renderer, *std::move(mirrors));
  });
}

class RefractedObjectsTest : public gl::ContextTest {};

const glm::vec3 eye{2.4f, -5.2f, 2.6f}, target{0, 0, 1};

// FLIP's floor is what four samples per pixel make of edges, of which a ball lens shows many.
TEST_F(RefractedObjectsTest, ABallShowsItsSurroundingsUpsideDown) {
  const scene::Scene scene =
      among_boxes(scene::sphere(glm::vec3(0.0f), 1.0f, 64), glass(), placed({0, 0, 1.1f}));
  const Compared ball = draw(scene, eye, target);
  EXPECT_LT(ball.flip(), 0.08);
  EXPECT_GT(draw(scene, eye, target, Shown::sky).flip(), 3.0 * ball.flip());
  const render::GoldenTolerance tolerance{160, 24, 0.005, 0.2};
  const Status golden = render::matches_golden(ball.ours, "glass-ball", tolerance, source_folder());
  EXPECT_TRUE(golden) << to_string(golden.errors());
}

TEST_F(RefractedObjectsTest, SoDoEllipsoidsThatAreTurnedAndScaled) {
  Mesh mesh;
  append(mesh, scene::sphere(glm::vec3(0.0f), 2.0f, 64), glm::scale(glm::mat4(1.0f), {1.2f, 0.9f, 1.0f}));
  const glm::mat4 half = glm::scale(glm::rotate(placed({0, 0, 1.2f}), 0.5f, {0, 0, 1}), glm::vec3(0.5f));
  const scene::Scene scene = among_boxes(mesh, glass(1.7f), half);
  EXPECT_LT(draw(scene, eye, target).flip(), 0.15);
}

TEST_F(RefractedObjectsTest, TintedGlassAbsorbs) {
  scene::Material green = glass();
  green.absorption_per_m = {0.8f, 0.1f, 0.7f};
  EXPECT_LT(
      draw(among_boxes(scene::sphere(glm::vec3(0.0f), 0.8f, 48), green, placed({0, 0, 0.9f})), eye, target)
          .flip(),
      0.08);
}

TEST_F(RefractedObjectsTest, WhatIsBakedIsLookedUp) {
  const TestFolder folder;
  scene::Scene scene = among_boxes(scene::sphere(glm::vec3(0.0f), 1.0f, 24), glass(), placed({0, 0, 1.1f}));
  scene.file = folder.path() / "ball.xp";
  methods::settings(scene).method = "rerendered_cube_map";
  const Result<BakedReflectors> baked = bake_reflectors(scene);
  ASSERT_TRUE(baked);
  ASSERT_EQ(baked->files.size(), 1u);
  const auto is_made_anew = [&] {
    testing::internal::CaptureStderr();
    draw(scene, eye, target);
    return testing::internal::GetCapturedStderr().find("is rebuilt") != std::string::npos;
  };
  EXPECT_FALSE(is_made_anew());
  ASSERT_TRUE(write_file(*baked->files.begin(), "no reflector"));
  EXPECT_TRUE(is_made_anew());
}

TEST_F(RefractedObjectsTest, TwoBodiesEachShowTheirOwn) {
  scene::Scene scene =
      among_boxes(scene::sphere(glm::vec3(0.0f), 0.6f, 48), glass(), placed({-0.9f, 0, 0.8f}));
  scene.objects.push_back(scene.objects.back());
  scene.objects.back().world_from_model = placed({0.9f, -0.4f, 0.8f});
  EXPECT_LT(draw(scene, eye, target).flip(), 0.12);
}

/// Three balls in one mesh, and one of another glass in a part of its own, as chandeliers have their drops.
TEST_F(RefractedObjectsTest, BodiesOfOneModelEachShowTheirOwn) {
  Mesh balls = scene::sphere({-0.9f, 0, 0.7f}, 0.6f, 32);
  append(balls, scene::sphere({0.9f, -0.2f, 0.7f}, 0.6f, 32));
  append(balls, scene::sphere({-0.2f, -0.3f, 1.9f}, 0.4f, 32));
  scene::Scene scene = among_boxes(balls, glass(), glm::mat4(1.0f));
  auto model = std::make_shared<scene::Model>(*scene.objects.back().model);
  model->parts.push_back({.object = "drop", .mesh = scene::sphere({0.1f, -0.9f, 0.5f}, 0.35f, 32)});
  model->parts.back().material = 1;
  model->materials.push_back(glass(1.33f));
  model->materials.back().absorption_per_m = {2.0f, 0.2f, 1.6f};
  scene::divide_glass(*model);
  EXPECT_EQ(model->parts.size(), 4u);
  scene.objects.back().model = model;
  const double flip = draw(scene, eye, target).flip();
  EXPECT_LT(flip, 0.12);
  EXPECT_GT(draw(scene, eye, target, Shown::sky).flip(), 2.0 * flip);
}

/// A body that light is not followed through is a pane: things behind it are seen as if there were no glass.
/// (The index is one by which little is mirrored, but at rims: there FLIP is not 0.)
TEST_F(RefractedObjectsTest, OpenConcaveAndSqueezedBodiesArePanes) {
  const glm::mat4 above = placed({0, 0, 1.1f});
  const auto expect_pane = [&](const Mesh& body, const glm::mat4& world_from_body) {
    scene::Scene scene = among_boxes(body, glass(1.001f), world_from_body);
    const Compared pane = draw(scene, eye, target);
    const Compared sky = draw_by(scene, eye, target, [](const scene::Scene& all, render::Renderer& renderer) {
      return make_virtual_objects(all, renderer);
    });
    scene.objects.back().is_visible = false;
    const Compared nothing = draw(scene, eye, target);
    const auto unlike_nothing = [&](const Compared& shown) {
      return reference::compare(shown.ours, nothing.ours, pane.mirrors)->flip;
    };
    EXPECT_LT(unlike_nothing(pane), 0.4 * unlike_nothing(sky));
  };
  const Mesh ball = scene::sphere(glm::vec3(0.0f), 1.0f, 24);
  Mesh open = ball, shell = scene::sphere(glm::vec3(0.0f), 0.6f, 24);
  open.indices.resize(open.indices.size() / 2);
  append(shell, scene::sphere(glm::vec3(0.0f), 0.5f, 24));
  expect_pane(open, above);
  expect_pane(shell, above);
  expect_pane(ball, glm::scale(above, {1, 1, 0.5f}));
}

TEST_F(RefractedObjectsTest, PanesAbsorb) {
  scene::Material green = glass();
  green.absorption_per_m = {20.0f, 2.0f, 15.0f};
  const Mesh pane = scene::box({-1.0f, -0.02f, -0.8f}, {1.0f, 0.02f, 0.8f});
  const auto drawn = [&](const scene::Material& material) {
    return draw(among_boxes(pane, material, placed({0, 0, 1})), {0.5f, -4, 1.2f}, {0, 0, 1});
  };
  const Compared tinted = drawn(green), clear = drawn(glass());
  EXPECT_LT(2.0 * tinted.flip(), reference::compare(clear.ours, tinted.traced, tinted.mirrors)->flip);
}

/// Light passes two walls on its way through a shell, hence as much is left as of two panes.
TEST_F(RefractedObjectsTest, ShellsAbsorbAsTheirWallsDo) {
  Mesh shell = scene::sphere(glm::vec3(0.0f), 0.9f, 32);
  append(shell, scene::sphere(glm::vec3(0.0f), 0.88f, 32));
  scene::Material clear = glass(1.001f), green = clear;
  green.absorption_per_m = {20.0f, 2.0f, 15.0f};
  const auto middle = [&](const scene::Material& material) {
    const Image8 picture = draw(among_boxes(shell, material, placed({0, 0, 1})), eye, target).ours;
    const std::uint8_t* pixel = picture.at(width / 2, height / 2);
    return glm::vec3(pixel[0], pixel[1], pixel[2]);
  };
  const glm::vec3 without = middle(clear), with = middle(green);
  EXPECT_GT(with.x, 0.4f * without.x);
  EXPECT_LT(with.x, 0.9f * without.x);
  EXPECT_GT(with.y, 0.9f * without.y);
}

TEST_F(RefractedObjectsTest, AViewerWithinAndThingsThatTouchAreStood) {
  scene::Scene scene =
      among_boxes(scene::sphere(glm::vec3(0.0f), 1.0f, 24), glass(), placed({0, 0, 0.4f}));  // in the floor
  EXPECT_LT(draw(scene, eye, target).flip(), 0.5);  // what stands in the glass is not shown
  const Compared within = draw(scene, {0, 0, 0.4f}, {3, 0, 0.4f});
  EXPECT_LT(reference::compare(within.ours, within.traced, {})->flip, 0.05);
}

}  // namespace
}  // namespace parvis::refraction
