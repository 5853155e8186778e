#include "curved_reflectors/virtual_objects.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "gl/test_context.h"
#include "reference/metrics.h"
#include "reference/tracer.h"
#include "render/golden.h"
#include "render/test_room.h"
#include "shading/tone_curve.h"

namespace parvis::curved_reflectors {
namespace {

constexpr int width = 320, height = 240;

/// Each triangle in `parts` squared ones: only corners are mirrored exactly.
Mesh divided(const Mesh& mesh, int parts) {
  Mesh fine;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::uint32_t* corner = &mesh.indices[i];
    const std::uint32_t first = std::uint32_t(fine.positions.size());
    for (int b = 0; b <= parts; ++b)
      for (int c = 0; b + c <= parts; ++c) {
        const float v = float(b) / float(parts), w = float(c) / float(parts), u = 1.0f - v - w;
        fine.positions.push_back(u * mesh.positions[corner[0]] + v * mesh.positions[corner[1]] +
                                 w * mesh.positions[corner[2]]);
        fine.normals.push_back(mesh.normals[corner[0]]);
        fine.uvs.push_back(u * mesh.uvs[corner[0]] + v * mesh.uvs[corner[1]] + w * mesh.uvs[corner[2]]);
      }
    const auto at = [&](int b, int c) {
      return first + std::uint32_t(b * (parts + 1) - b * (b - 1) / 2 + c);
    };
    for (int b = 0; b < parts; ++b)
      for (int c = 0; b + c < parts; ++c) {
        for (const std::uint32_t v : {at(b, c), at(b + 1, c), at(b, c + 1)}) fine.indices.push_back(v);
        if (b + c + 1 < parts)
          for (const std::uint32_t v : {at(b + 1, c), at(b + 1, c + 1), at(b, c + 1)})
            fine.indices.push_back(v);
      }
  }
  return fine;
}

/// A floor of squares and boxes of several colours round a mirror of this shape.
scene::Scene among_boxes(const Mesh& mirror, const glm::mat4& world_from_mirror) {
  scene::Scene scene;
  scene.sun.direction_to_sun = glm::normalize(glm::vec3(-0.5f, -0.4f, 0.8f));
  for (int y = -4; y < 4; ++y)
    for (int x = -4; x < 4; ++x) {
      const glm::vec3 low(float(x), float(y), 0.0f);
      const glm::vec3 grey((x + y) % 2 ? 0.15f : 0.6f);
      scene::add(scene,
                 scene::model_of(divided(scene::quad(low, low + glm::vec3(1, 0, 0), low + glm::vec3(1, 1, 0),
                                                     low + glm::vec3(0, 1, 0)),
                                         8),
                                 scene::matt(grey)));
    }
  const auto box = [&](glm::vec3 low, glm::vec3 size, glm::vec3 colour) {
    scene::add(scene, scene::model_of(divided(scene::box(low, low + size), 12), scene::matt(colour)));
  };
  box({-2.6f, -1.5f, 0}, {0.7f, 0.7f, 1.6f}, {0.8f, 0.1f, 0.1f});
  box({1.7f, -2.2f, 0}, {0.8f, 0.6f, 1.1f}, {0.1f, 0.6f, 0.1f});
  box({-0.6f, -3.4f, 0}, {0.9f, 0.5f, 2.0f}, {0.1f, 0.2f, 0.8f});
  box({-1.0f, 2.2f, 0}, {2.0f, 0.4f, 1.4f}, {0.9f, 0.7f, 0.1f});
  std::shared_ptr<scene::Model> model = scene::model_of(mirror, scene::Material());
  model->materials = render::mirror_box(1.0f)->materials;
  model->name = "mirror";
  const int object = scene::add(scene, model, true, world_from_mirror);
  scene.objects[std::size_t(object)].takes_reflection = true;
  scene.reflection.method = scene::ReflectionMethod::virtual_objects;
  return scene;
}

glm::mat4 placed(glm::vec3 at) { return glm::translate(glm::mat4(1.0f), at); }

/// A picture of a scene by virtual objects, and what ray tracing makes of it.
struct Compared {
  Image8 ours, traced, mirrors;

  /// FLIP inside the mirrors.
  double flip() const {
    const Result<reference::Difference> difference = reference::compare(ours, traced, mirrors);
    EXPECT_TRUE(difference) << to_string(difference.errors());
    return difference ? difference->flip : 1.0;
  }
};

enum class Mirrored { sky, objects };

Compared draw(const scene::Scene& scene, glm::vec3 eye, glm::vec3 target,
              Mirrored mirrored = Mirrored::objects) {
  Result<std::unique_ptr<render::Renderer>> renderer = render::Renderer::create(scene);
  EXPECT_TRUE(renderer) << to_string(renderer.errors());
  Result<std::unique_ptr<render::Reflections>> reflections = make_virtual_objects(scene, **renderer);
  EXPECT_TRUE(reflections) << to_string(reflections.errors());
  EXPECT_TRUE(mirrored == Mirrored::objects || (*renderer)->set_reflection(nullptr));
  Camera camera;
  camera.world_from_camera = look_at(eye, target);
  (*renderer)->begin_frame(scene, camera);
  (*renderer)->prepare_main_view(camera, width, height);
  (*reflections)->update(**renderer, scene, camera);
  (*renderer)->draw_main_view();
  reference::TraceOptions options;
  const shading::DrawnLight light = (*renderer)->drawn_light();
  options.drawn_light = &light;
  const reference::RayScene rays(scene);
  const reference::TracedPicture truth =
      reference::trace_picture(rays, scene, (*renderer)->sky(), camera, width, height, options);
  return {(*renderer)->read_picture(scene.exposure),
          shading::tone_mapped_picture(truth.radiance, scene.exposure), truth.mirror_mask};
}

class VirtualObjectsTest : public gl::ContextTest {};

const glm::vec3 eye{2.4f, -5.2f, 2.6f}, target{0, 0, 1};

// FLIP's floor here is what four samples a pixel and a mirror's rim of a pixel make of it.
TEST_F(VirtualObjectsTest, ABallShowsWhatRaysMeet) {
  const scene::Scene scene = among_boxes(scene::sphere(glm::vec3(0.0f), 1.0f, 64), placed({0, 0, 1.1f}));
  const Compared ball = draw(scene, eye, target);
  const double by_virtual_objects = ball.flip();
  EXPECT_LT(by_virtual_objects, 0.04);
  // Another compiler's last bits move a search's end by less than a tenth of a pixel, which edges may show.
  const render::GoldenTolerance tolerance{160, 24, 0.005, 0.2};
  const Status golden =
      render::matches_golden(ball.ours, "virtual-objects-ball", tolerance, PARVIS_SOURCE_DIR);
  EXPECT_TRUE(golden) << to_string(golden.errors());
  EXPECT_GT(draw(scene, eye, target, Mirrored::sky).flip(), 5.0 * by_virtual_objects)
      << "the sky alone is told";
}

TEST_F(VirtualObjectsTest, AnEllipsoidThatIsTurnedAndScaledDoes) {
  Mesh mesh;
  append(mesh, scene::sphere(glm::vec3(0.0f), 2.0f, 64), glm::scale(glm::mat4(1.0f), {1.6f, 0.8f, 0.7f}));
  const glm::mat4 half = glm::scale(glm::rotate(placed({0, 0, 1.0f}), 0.5f, {0, 0, 1}), glm::vec3(0.5f));
  EXPECT_LT(draw(among_boxes(mesh, half), eye, target).flip(), 0.04);
}

/// The inside of a ball, open toward the viewer, and so shallow that it hardly shows itself.
TEST_F(VirtualObjectsTest, ABowlShowsThingsUpsideDown) {
  Mesh bowl = scene::sphere(glm::vec3(0.0f), 1.0f, 64);
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < bowl.indices.size(); i += 3)
    if (bowl.positions[bowl.indices[i]].z < -0.75f && bowl.positions[bowl.indices[i + 2]].z < -0.75f)
      kept.insert(kept.end(), {bowl.indices[i], bowl.indices[i + 2], bowl.indices[i + 1]});
  bowl.indices = kept;
  for (glm::vec3& normal : bowl.normals) normal = -normal;
  const glm::mat4 tilted =
      glm::rotate(glm::rotate(placed({0, 0.8f, 1.3f}), 0.4f, {0, 0, 1}), 1.2f, {1, 0, 0});
  EXPECT_LT(draw(among_boxes(bowl, tilted), eye, target).flip(), 0.08);
}

/// A torus shows most things twice: on its outside, and within its ring.
TEST_F(VirtualObjectsTest, ATorusShowsThingsSeveralTimes) {
  const glm::mat4 standing = glm::rotate(placed({0, 0, 1.1f}), 1.2f, {1, 0, 0});
  scene::Scene scene = among_boxes(scene::torus(0.8f, 0.3f, 48), standing);
  scene.reflection.resolution = 40;  // maps in seconds
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

TEST_F(VirtualObjectsTest, TwoMirrorsShowWhatTheOtherShows) {
  scene::Scene scene = two_balls();
  const glm::vec3 near_eye{-0.2f, -2.0f, 1.1f}, at_first{-0.6f, 0, 0.8f};
  Compared once = draw(scene, near_eye, at_first);
  scene.reflection.bounces = 2;
  Compared twice = draw(scene, near_eye, at_first);
  twice.mirrors = once.mirrors = different(once.traced, twice.traced);  // a mirror in a mirror
  once.traced = twice.traced;
  EXPECT_LT(twice.flip(), 0.25);  // the image is 60 pixels high, and all edges
  EXPECT_LT(twice.flip(), 0.5 * once.flip());
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
}  // namespace parvis::curved_reflectors
