#include "reflections/virtual_objects/virtual_objects.h"

#include <gtest/gtest.h>

#include "base/test_data.h"
#include "graphics/gl/test_context.h"
#include "graphics/render/test_golden.h"
#include "reflections/reflector_maps/settings.h"
#include "reflections/reflector_maps/test_boxes.h"
#include "reflections/virtual_objects/search_settings.h"

namespace parvis::virtual_objects {
using namespace reflection_search;
using namespace reflector_maps;
namespace {

enum class Mirrored { sky, objects };

Compared draw(const scene::Scene& scene, glm::vec3 eye, glm::vec3 target,
              Mirrored mirrored = Mirrored::objects) {
  return draw_by(scene, eye, target, [&](const scene::Scene& shown, render::Renderer& renderer) {
    return mirrored == Mirrored::objects ? make_virtual_objects(shown, renderer)
                                         : std::unique_ptr<methods::Reflections>();
  });
}

scene::Scene among_boxes(const Mesh& mirror, const glm::mat4& world_from_mirror) {
  return reflector_maps::among_boxes(mirror, render::mirror_box(1.0f)->materials.front(), world_from_mirror);
}

class VirtualObjectsTest : public gl::ContextTest {};

const glm::vec3 eye{2.4f, -5.2f, 2.6f}, target{0, 0, 1};

// FLIP's floor here is what four samples per pixel and a mirror's rim of a pixel make of it.
TEST_F(VirtualObjectsTest, ABallShowsWhatRaysHit) {
  const scene::Scene scene = among_boxes(scene::sphere(glm::vec3(0.0f), 1.0f, 64), placed({0, 0, 1.1f}));
  const Compared ball = draw(scene, eye, target);
  const double by_virtual_objects = ball.flip();
  EXPECT_LT(by_virtual_objects, 0.04);
  // Another compiler's last bits move a search's end by less than a tenth of a pixel, which edges may show.
  const render::GoldenTolerance tolerance{160, 24, 0.005, 0.2};
  const Status golden = render::matches_golden(ball.ours, "virtual-objects-ball", tolerance, source_folder());
  EXPECT_TRUE(golden) << to_string(golden.errors());
  EXPECT_GT(draw(scene, eye, target, Mirrored::sky).flip(), 5.0 * by_virtual_objects)
      << "the sky alone is reported";
}

TEST_F(VirtualObjectsTest, AnEllipsoidThatIsTurnedAndScaledDoes) {
  Mesh mesh;
  append(mesh, scene::sphere(glm::vec3(0.0f), 2.0f, 64), glm::scale(glm::mat4(1.0f), {1.6f, 0.8f, 0.7f}));
  const glm::mat4 half = glm::scale(glm::rotate(placed({0, 0, 1.0f}), 0.5f, {0, 0, 1}), glm::vec3(0.5f));
  EXPECT_LT(draw(among_boxes(mesh, half), eye, target).flip(), 0.04);
}

/// Section 5: the corners of a grid searched for, the boxes' vertices interpolated. (The floor's squares have
/// too few for a grid.)
TEST_F(VirtualObjectsTest, AVirtualGridShowsTheSame) {
  scene::Scene scene = among_boxes(scene::sphere(glm::vec3(0.0f), 1.0f, 64), placed({0, 0, 1.1f}));
  const Compared by_area = draw(scene, eye, target);
  methods::settings(scene).uses_level_of_detail = false;
  const Compared searched = draw(scene, eye, target);
  const double by_area_flip = reference::compare(by_area.ours, searched.ours, searched.mirrors)->flip;
  EXPECT_GT(by_area_flip, 0.0) << "no grid was used";
  EXPECT_LT(by_area_flip, 0.003);
  double last = 1.0;
  for (const float share : {0.01f, 0.041f, 0.143f}) {
    search_settings(scene).grid_share = share;
    const Compared interpolated = draw(scene, eye, target);
    const double flip = reference::compare(interpolated.ours, searched.ours, searched.mirrors)->flip;
    EXPECT_GT(flip, 0.0) << "no grid was used";
    EXPECT_LT(flip, last) << "more corners are nearer";
    last = flip;
  }
  EXPECT_LT(last, 0.01);
}

/// A search that may take one step alone ends beside the reflection points; nine are near them.
TEST_F(VirtualObjectsTest, TheMidpointSearchComesNearerWithEachIteration) {
  scene::Scene scene = among_boxes(scene::sphere(glm::vec3(0.0f), 1.0f, 64), placed({0, 0, 1.1f}));
  search_settings(scene).search = SearchMethod::midpoint;
  search_settings(scene).iterations = 1;
  const double one = draw(scene, eye, target).flip();
  search_settings(scene).iterations = 9;
  EXPECT_LT(draw(scene, eye, target).flip(), 0.5 * one);
}

/// The inside of a ball below `rim`.
Mesh bowl_below(float rim) {
  Mesh bowl = scene::sphere(glm::vec3(0.0f), 1.0f, 64);
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < bowl.indices.size(); i += 3)
    if (bowl.positions[bowl.indices[i]].z < rim && bowl.positions[bowl.indices[i + 2]].z < rim)
      kept.insert(kept.end(), {bowl.indices[i], bowl.indices[i + 2], bowl.indices[i + 1]});
  bowl.indices = kept;
  for (glm::vec3& normal : bowl.normals) normal = -normal;
  return bowl;
}

/// So shallow that it hardly shows itself.
Mesh shallow_bowl() { return bowl_below(-0.75f); }

TEST_F(VirtualObjectsTest, ABowlShowsThingsUpsideDown) {
  const glm::mat4 tilted =
      glm::rotate(glm::rotate(placed({0, 0.8f, 1.3f}), 0.4f, {0, 0, 1}), 1.2f, {1, 0, 0});
  EXPECT_LT(draw(among_boxes(shallow_bowl(), tilted), eye, target).flip(), 0.08);
}

TEST_F(VirtualObjectsTest, ABowlThatIsPaintedShowsItselfInItsPaint) {
  const glm::mat4 tilted =
      glm::rotate(glm::rotate(placed({0, 0.8f, 1.3f}), 0.4f, {0, 0, 1}), 1.2f, {1, 0, 0});
  const scene::Material steel = render::mirror_box(1.0f)->materials.front();
  scene::Material copper = steel;
  copper.base_colour = {0.9f, 0.5f, 0.3f};
  scene::Scene painted = reflector_maps::among_boxes(bowl_below(-0.2f), steel, tilted);
  for (scene::Object& object : painted.objects)
    if (object.takes_reflection)
      object.paint = std::make_shared<const std::vector<scene::Material>>(1, copper);
  const scene::Scene of_copper = reflector_maps::among_boxes(bowl_below(-0.2f), copper, tilted);
  EXPECT_EQ(draw(painted, eye, target).ours.pixels, draw(of_copper, eye, target).ours.pixels);
}

/// A surface that covers a part of a pixel, in a dark room under a bright sky, shows nothing of the sky in
/// others.
TEST_F(VirtualObjectsTest, OutlinesShowNoSurroundingsThroughWhatCoversThem) {
  scene::Scene scene = among_boxes(scene::sphere(glm::vec3(0.0f), 1.0f, 64), placed({0, 0, 1.1f}));
  Mesh room = divided(scene::box(glm::vec3(-7.0f, -7.0f, -0.1f), glm::vec3(7.0f, 7.0f, 6.0f)), 24);
  for (std::size_t i = 0; i < room.indices.size(); i += 3) std::swap(room.indices[i], room.indices[i + 1]);
  for (glm::vec3& normal : room.normals) normal = -normal;
  scene::add(scene, scene::model_of(room, scene::matt(glm::vec3(0.02f))));
  scene.exposure = 4.0f;
  const Compared ball = draw(scene, eye, target);
  int lighter = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      lighter += ball.mirrors.at(x, y)[0] >= 128 && ball.ours.at(x, y)[2] > ball.traced.at(x, y)[2] + 60;
  EXPECT_LE(lighter, 4);
}

/// A barrel whose normals turn down a little in its last row: what lies low is shown twice by it or not at
/// all. Triangles that reach there are shown as far as it shows them.
TEST_F(VirtualObjectsTest, ARimThatFlaresShowsWhatReachesIt) {
  constexpr int around = 64, rows = 24;
  Mesh barrel;
  for (int row = 0; row <= rows; ++row)
    for (int i = 0; i <= around; ++i) {
      const float z = float(row) / rows - 0.5f, turn = 6.2831853f * float(i) / around;
      const glm::vec3 outward(std::cos(turn), std::sin(turn), 0.0f);
      const float flare = row == rows ? -0.12f : 0.0f;
      barrel.positions.push_back((1.0f - 0.3f * z * z) * outward + glm::vec3(0, 0, z));
      barrel.normals.push_back(glm::normalize(outward + glm::vec3(0, 0, 0.6f * z + flare)));
      barrel.uvs.emplace_back(0.0f);
    }
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < around; ++i) {
      const std::uint32_t low = std::uint32_t(row * (around + 1) + i), high = low + around + 1;
      barrel.indices.insert(barrel.indices.end(), {low, low + 1, high + 1, low, high + 1, high});
    }
  EXPECT_LT(draw(among_boxes(barrel, placed({0, 0, 0.6f})), eye, target).flip(), 0.045);
}

/// A ball beside a box, and a smaller ball before it, as the eye sees them, that has nothing near.
scene::Scene two_balls(glm::vec3 box_colour, bool has_front) {
  scene::Scene scene;
  near_object_settings(scene).within_m = 1.0f;
  methods::settings(scene).uses_level_of_detail = false;
  scene::add(scene, scene::model_of(divided(scene::box({0.7f, -1.4f, 0.4f}, {1.6f, -0.7f, 1.8f}), 12),
                                    scene::matt(box_colour)));
  const scene::Material& mirror = render::mirror_box(1.0f)->materials.front();
  const auto add_ball = [&](glm::vec3 centre, float radius) {
    const auto ball = scene::model_of(scene::sphere(glm::vec3(0.0f), radius, 48), mirror);
    scene.objects[std::size_t(scene::add(scene, ball, true, placed(centre)))].takes_reflection = true;
  };
  add_ball({0, 0, 1.1f}, 1.0f);
  if (has_front) add_ball({0.3f, -2.9f, 1.1f}, 0.2f);
  return scene;
}

TEST_F(VirtualObjectsTest, AMirrorShowsNothingOfWhatAnotherMirrorsBehindIt) {
  const glm::vec3 before{0.3f, -5.2f, 1.1f}, ahead{0.3f, 0, 1.1f};
  const auto picture = [&](glm::vec3 box_colour, bool has_front) {
    return draw(two_balls(box_colour, has_front), before, ahead).ours;
  };
  const Image8 red = picture({0.8f, 0, 0}, true), green = picture({0, 0.8f, 0}, true);
  const Image8 red_behind = picture({0.8f, 0, 0}, false), green_behind = picture({0, 0.8f, 0}, false);
  const scene::Scene scene = two_balls(glm::vec3(0.5f), true);
  Camera camera;
  camera.world_from_camera = look_at(before, ahead);
  const reference::ObjectPicture objects =
      reference::trace_objects(reference::RayScene(scene), camera, width, height);
  const std::uint32_t front = std::uint32_t(scene.objects.size());
  const auto is_all_front = [&](int x, int y) {
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        if (*objects.at(x + i, y + j) != front) return false;
    return true;
  };
  const auto differs = [](const Image8& a, const Image8& b, int x, int y) {
    return std::abs(a.at(x, y)[0] - b.at(x, y)[0]) > 8;
  };
  int seen_through = 0, behind = 0, beside = 0;
  for (int y = 1; y < height - 1; ++y)
    for (int x = 1; x < width - 1; ++x) {
      seen_through += is_all_front(x, y) && differs(red, green, x, y);
      behind += is_all_front(x, y) && differs(red_behind, green_behind, x, y);
      beside += *objects.at(x, y) + 1 == front && differs(red, green, x, y);
    }
  EXPECT_GT(behind, 20) << "the ball in front hides what the other mirrors";
  EXPECT_GT(beside, 20);
  EXPECT_EQ(seen_through, 0);
}

/// A torus shows most things twice: on its outside, and within its ring.
TEST_F(VirtualObjectsTest, ATorusShowsThingsSeveralTimes) {
  const glm::mat4 standing = glm::rotate(placed({0, 0, 1.1f}), 1.2f, {1, 0, 0});
  scene::Scene scene = among_boxes(scene::torus(0.8f, 0.3f, 48), standing);
  methods::settings(scene).resolution = 40;  // maps in seconds
  const Compared torus = draw(scene, eye, target);
  EXPECT_LT(torus.flip(), 0.45 * draw(scene, eye, target, Mirrored::sky).flip());
}

scene::Scene two_balls() {
  scene::Scene scene = among_boxes(scene::sphere(glm::vec3(0.0f), 0.7f, 48), placed({-0.9f, 0, 0.8f}));
  scene.objects.push_back(scene.objects.back());
  scene.objects.back().world_from_model = placed({1.0f, -0.4f, 0.8f});
  return scene;
}

TEST_F(VirtualObjectsTest, TwoMirrorsEachShowTheirOwn) {
  EXPECT_LT(draw(two_balls(), eye, target).flip(), 0.08);
}

/// Where two pictures differ.
Image8 different(const Image8& a, const Image8& b) {
  Image8 mask(a.width, a.height, 1);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i)
    mask.pixels[i] = std::abs(int(a.pixels[3 * i]) - int(b.pixels[3 * i])) > 8 ? 255 : 0;
  return mask;
}

/// FLIP where mirrors show mirrors, by one bounce and by two.
struct Bounces {
  double once, twice;
};
Bounces draw_bounces(scene::Scene scene, glm::vec3 from, glm::vec3 to) {
  Compared once = draw(scene, from, to);
  methods::settings(scene).bounces = 2;
  Compared twice = draw(scene, from, to);
  twice.mirrors = once.mirrors = different(once.traced, twice.traced);
  once.traced = twice.traced;
  return {once.flip(), twice.flip()};
}

TEST_F(VirtualObjectsTest, TwoMirrorsShowWhatTheOtherShows) {
  const Bounces flip = draw_bounces(two_balls(), {-0.2f, -2.0f, 1.1f}, {-0.6f, 0, 0.8f});
  EXPECT_LT(flip.twice, 0.25);  // the image is 60 pixels high, and all edges
  EXPECT_LT(flip.twice, 0.5 * flip.once);
}

/// A bowl that faces a ball: each shows what the other shows, the bowl in layers.
TEST_F(VirtualObjectsTest, ABowlAndABallShowWhatTheOtherShows) {
  scene::Scene scene = two_balls();
  scene.objects.pop_back();
  const glm::mat4 facing = glm::rotate(placed({0.1f, 0, 0.9f}), -1.5707964f, {0, 1, 0});
  const int added = scene::add(
      scene, scene::model_of(shallow_bowl(), render::mirror_box(1.0f)->materials.front()), true, facing);
  scene.objects[std::size_t(added)].takes_reflection = true;
  const Bounces ball = draw_bounces(scene, {-0.4f, -2.0f, 1.2f}, {-0.6f, 0, 0.8f});
  EXPECT_LT(ball.twice, 0.25);
  EXPECT_LT(ball.twice, 0.5 * ball.once);
  const Bounces bowl = draw_bounces(scene, {-0.7f, -1.5f, 1.7f}, {0.9f, 0, 0.8f});
  EXPECT_LT(bowl.twice, 0.6 * bowl.once);  // what it shows of itself counts, which is drawn once alone
}

TEST_F(VirtualObjectsTest, WhatTouchesCrossesOrSurroundsIsStood) {
  scene::Scene scene =
      among_boxes(scene::sphere(glm::vec3(0.0f), 1.0f, 24), placed({0, 0, 0.4f}));  // in the floor
  scene::add(scene, scene::model_of(divided(scene::box({-0.5f, -0.5f, 0.5f}, {2.0f, 0.5f, 1.6f}), 4),
                                    scene::matt(glm::vec3(0.5f))));
  EXPECT_LT(draw(scene, eye, target).flip(), 0.1);
  // Within the mirror its surface faces away and is not drawn: all else stands as it did.
  const Compared within = draw(scene, {0, 0, 0.4f}, {3, 0, 0.4f});
  EXPECT_LT(reference::compare(within.ours, within.traced, {})->flip, 0.05);
}

TEST_F(VirtualObjectsTest, AMeshThatCannotBeUsedMirrorsTheSky) {
  Mesh flat = scene::quad({-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  flat.normals.assign(4, glm::vec3(0, 0, 1));
  scene::Scene scene = among_boxes(flat, placed({0, 0, 1}));
  EXPECT_FALSE(draw(scene, eye, target).ours.empty());
  scene =
      among_boxes(scene::sphere(glm::vec3(0.0f), 1.0f, 24), glm::scale(placed({0, 0, 1.1f}), {1, 1, 0.5f}));
  const double squeezed = draw(scene, eye, target).flip();
  EXPECT_NEAR(squeezed, draw(scene, eye, target, Mirrored::sky).flip(), 1e-3);
}

}  // namespace
}  // namespace parvis::virtual_objects
