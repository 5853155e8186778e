#include "bench/virtual_objects/two_bounces.h"

#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "bench/flip_between.h"
#include "bench/judged_method.h"
#include "bench/virtual_objects/beside_rerendered.h"
#include "bench/virtual_objects/changed_pixels.h"
#include "graphics/gl/context.h"
#include "graphics/shading/tone_curve.h"
#include "places/paper_city/mirror_bodies.h"
#include "places/paper_city/walker.h"
#include "scene/data/test_scene.h"

namespace parvis::bench {
namespace {

constexpr int width = 960, height = 720, quick_width = 480, quick_height = 360;
constexpr int samples_per_pixel = 16;

void add_mirror(scene::Scene& scene, const std::shared_ptr<scene::Model>& model, glm::vec3 at,
                float radius_m) {
  const int object =
      scene::add(scene, model, true, glm::scale(glm::translate(glm::mat4(1.0f), at), glm::vec3(radius_m)));
  scene.objects[std::size_t(object)].takes_reflection = true;
}

/// Two mirror balls and a mirror egg on a chequered floor, among boxes, with a person before them.
scene::Scene mirrors_among_boxes() {
  scene::Scene scene;
  scene.sun.direction_to_sun = glm::normalize(glm::vec3(-0.5f, -0.4f, 0.8f));
  for (int y = -6; y < 6; ++y)
    for (int x = -6; x < 6; ++x) {
      const glm::vec3 low(float(x), float(y), 0.0f);
      scene::add(scene, scene::model_of(scene::quad(low, low + glm::vec3(1, 0, 0), low + glm::vec3(1, 1, 0),
                                                    low + glm::vec3(0, 1, 0)),
                                        scene::matt(glm::vec3((x + y) % 2 ? 0.15f : 0.6f))));
    }
  const auto box = [&](glm::vec3 low, glm::vec3 size, glm::vec3 colour) {
    scene::add(scene, scene::model_of(scene::box(low, low + size), scene::matt(colour)));
  };
  box({-2.6f, -1.5f, 0}, {0.7f, 0.7f, 1.6f}, {0.8f, 0.1f, 0.1f});
  box({1.9f, -2.2f, 0}, {0.8f, 0.6f, 1.1f}, {0.1f, 0.6f, 0.1f});
  box({-1.0f, 2.4f, 0}, {2.0f, 0.4f, 1.4f}, {0.9f, 0.7f, 0.1f});
  scene::add(scene, std::make_shared<scene::Model>(city::city_walkers().front()), true,
             glm::translate(glm::mat4(1.0f), {0.3f, -1.5f, 0.0f}));
  const auto ball = std::make_shared<scene::Model>(city::make_ball());
  const auto egg = std::make_shared<scene::Model>(*ball);
  for (scene::Part& part : egg->parts) {
    Mesh mesh;
    append(mesh, part.mesh, glm::scale(glm::mat4(1.0f), {0.75f, 0.75f, 1.0f}));
    part.mesh = mesh;
  }
  add_mirror(scene, ball, {-0.9f, 0.0f, 0.8f}, 0.75f);
  add_mirror(scene, ball, {0.9f, -0.2f, 0.75f}, 0.7f);
  add_mirror(scene, egg, {0.1f, 1.3f, 0.85f}, 0.8f);
  methods::settings(scene).method = "virtual_objects";
  methods::settings(scene).bounces = 2;
  return scene;
}

struct Place {
  glm::vec3 eye, target;
};
constexpr std::array places{Place{{-0.2f, -2.2f, 1.2f}, {-0.6f, 0.0f, 0.8f}},
                            Place{{1.8f, -3.2f, 2.0f}, {0.0f, 0.2f, 0.8f}},
                            Place{{-2.6f, 0.9f, 1.3f}, {0.3f, 0.4f, 0.8f}}};

/// What the ray tracer makes of a view, with as many bounces.
reference::TracedPicture truth_of(house::Stage& stage, const Camera& camera, int w, int h, int bounces) {
  methods::settings(stage.play().scene).bounces = bounces;
  return stage.trace(camera, w, h, samples_per_pixel);
}

}  // namespace

Status measure_two_bounces(const BenchSetup& setup, Report& report) {
  const int w = setup.is_quick ? quick_width : width, h = setup.is_quick ? quick_height : height;
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  Result<std::unique_ptr<house::Stage>> made =
      house::Stage::create(house::make_play(setup.house, mirrors_among_boxes()));
  if (!made) return made.errors();
  house::Stage& stage = **made;
  const methods::Settings twice = methods::settings(stage.scene());
  methods::Settings once = twice;
  once.bounces = 1;
  const Result<std::vector<JudgedMethod>> methods =
      judged_methods(stage, {{"two bounces", twice},
                             {"one bounce", once},
                             {"re-rendered cube maps", rerendered_baseline(stage.scene())}});
  if (!methods) return methods.errors();
  std::array<double, 3> in_mirrors{}, in_mirrors_in_mirrors{};
  for (const Place& place : places) {
    Camera camera;
    camera.world_from_camera = look_at(place.eye, place.target);
    const reference::TracedPicture truth = truth_of(stage, camera, w, h, 2);
    const auto toned = [&](const reference::TracedPicture& picture) {
      return shading::tone_mapped_picture(picture.radiance, stage.scene().exposure);
    };
    const Image8 expected = toned(truth);
    const Image8 twice_mirrored =
        changed_pixels(expected, toned(truth_of(stage, camera, w, h, 1)), truth.mirror_mask);
    for (std::size_t m = 0; m < methods->size(); ++m) {
      const Result<Image8> picture = picture_of(stage, (*methods)[m], camera, w, h, {0, 0, w, h});
      const Result<double> flip = flip_between(picture, expected, truth.mirror_mask),
                           flip_twice = flip_between(picture, expected, twice_mirrored);
      if (!flip) return flip.errors();
      if (!flip_twice) return flip_twice.errors();
      in_mirrors[m] += *flip / places.size();
      in_mirrors_in_mirrors[m] += *flip_twice / places.size();
    }
  }
  for (std::size_t m = 0; m < methods->size(); ++m)
    report.note(fmt::format("{}: FLIP {:.4f} inside mirrors, {:.4f} where they show mirrors",
                            (*methods)[m].name, in_mirrors[m], in_mirrors_in_mirrors[m]));
  constexpr double max_ratio = 0.4;
  report.add("two_bounce_flip_over_rerendered", in_mirrors_in_mirrors[0] / in_mirrors_in_mirrors[2],
             up_to(max_ratio));
  report.add_control("two_bounce_flip_over_rerendered_of_one_bounce",
                     in_mirrors_in_mirrors[1] / in_mirrors_in_mirrors[2], up_to(max_ratio));
  report.add("two_bounce_flip_in_all_mirrors", in_mirrors[0] / in_mirrors[2]);
  return Done{};
}

}  // namespace parvis::bench
