#include "bench/virtual_objects/bonnet.h"

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "base/colour.h"
#include "bench/flip_between.h"
#include "bench/judged_method.h"
#include "bench/virtual_objects/changed_pixels.h"
#include "graphics/gl/context.h"
#include "graphics/shading/tone_curve.h"
#include "places/paper_city/car.h"
#include "places/paper_city/walker.h"
#include "reflections/reference_maps/settings.h"
#include "reflections/reflector_maps/settings.h"
#include "scene/data/test_scene.h"

namespace parvis::bench {
namespace {

constexpr int width = 960, height = 600, quick_width = 640, quick_height = 400;
constexpr int samples_per_pixel = 16;
constexpr float virtual_within_m = 3.0f;
constexpr std::size_t black_saloon = 1;                           // of city_cars
const Bounds bonnet{{0.85f, -0.8f, 0.55f}, {2.15f, 0.8f, 1.0f}};  // of the saloon

/// Where a person stands, 1 m from the bonnet, and where they are seen in it from.
struct Meeting {
  glm::vec2 person;
  glm::vec3 eye;
};
constexpr std::array meetings{Meeting{{1.5f, 1.85f}, {2.1f, -2.6f, 1.6f}},
                              Meeting{{1.0f, -1.85f}, {1.9f, 2.7f, 1.6f}},
                              Meeting{{2.4f, -1.7f}, {1.1f, 2.9f, 1.6f}}};

/// A street between two rows of houses, with a black car in it and a person, the last object.
scene::Scene street() {
  scene::Scene scene;
  scene.sun.direction_to_sun = glm::normalize(glm::vec3(-0.35f, -0.55f, 0.75f));
  scene::add(scene, scene::model_of(scene::ground(60.0f), scene::matt(glm::vec3(0.12f))));
  constexpr std::array<glm::ivec3, 5> paints{
      {{0xD9, 0xA8, 0x66}, {0xBF, 0x6A, 0x45}, {0xEA, 0xDF, 0xC8}, {0x6F, 0x8F, 0xA3}, {0xCB, 0xBF, 0xA8}}};
  for (int i = -4; i < 4; ++i)
    for (const float side : {-1.0f, 1.0f}) {
      const glm::ivec3 paint = paints[std::size_t(2 * i + (side > 0.0f ? 11 : 8)) % paints.size()];
      const float x = 10.0f * float(i), y = side * 9.0f, height_m = 9.0f + 2.0f * float((i + 8) % 3);
      const glm::vec3 low(x, std::min(y, y + side * 8.0f), 0.0f),
          high(x + 10.0f, std::max(y, y + side * 8.0f), height_m);
      scene::add(scene, scene::model_of(scene::box(low, high),
                                        scene::matt(linear_from_srgb8(paint.x, paint.y, paint.z))));
    }
  const int car = scene::add(scene, std::make_shared<scene::Model>(city::city_cars()[black_saloon]), true);
  scene.objects[std::size_t(car)].takes_reflection = true;
  scene.objects[std::size_t(car)].name = "car";
  scene::add(scene, std::make_shared<scene::Model>(city::city_walkers().front()), true);
  methods::settings(scene).method = "multiple_environment_maps";
  methods::own_settings<reference_maps::MapSettings>(scene).max_maps = 12;
  reference_maps::map_plan(scene).places = {{-16, 0, 1.5f}, {-8, 0, 1.5f}, {-4, 0, 1.5f}, {0, 4, 1.5f},
                                            {0, -4, 1.5f},  {4, 0, 1.5f},  {8, 0, 1.5f},  {16, 0, 1.5f}};
  return scene;
}

/// The pixels of the bonnet, and a little more.
reference::PixelWindow window_of_bonnet(const Camera& camera, int w, int h) {
  const glm::mat4 clip_from_world = camera.clip_from_camera(float(w) / float(h)) * camera.camera_from_world();
  glm::vec2 low(1e9f), high(-1e9f);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p(corner & 1 ? bonnet.max.x : bonnet.min.x, corner & 2 ? bonnet.max.y : bonnet.min.y,
                      corner & 4 ? bonnet.max.z : bonnet.min.z);
    const glm::vec4 clip = clip_from_world * glm::vec4(p, 1.0f);
    const glm::vec2 at =
        glm::vec2(0.5f + 0.5f * clip.x / clip.w, 0.5f - 0.5f * clip.y / clip.w) * glm::vec2(w, h);
    low = glm::min(low, at), high = glm::max(high, at);
  }
  const glm::ivec2 first = glm::clamp(glm::ivec2(low), glm::ivec2(0), glm::ivec2(w - 1, h - 1));
  const glm::ivec2 end = glm::clamp(glm::ivec2(high) + 1, first + 1, glm::ivec2(w, h));
  return {first.x, first.y, end.x - first.x, end.y - first.y};
}

}  // namespace

Status measure_bonnet(const BenchSetup& setup, Report& report) {
  const int w = setup.is_quick ? quick_width : width, h = setup.is_quick ? quick_height : height;
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  Result<std::unique_ptr<house::Stage>> made = house::Stage::create(house::make_play(setup.house, street()));
  if (!made) return made.errors();
  house::Stage& stage = **made;
  methods::Settings near = methods::settings(stage.scene());
  near.own.get<reflector_maps::NearObjectSettings>().within_m = virtual_within_m;
  const Result<std::vector<JudgedMethod>> methods =
      judged_methods(stage, {{"with virtual objects", near}, {"maps", methods::settings(stage.scene())}});
  if (!methods) return methods.errors();
  std::array<double, 2> sums{};
  for (const Meeting& meeting : meetings) {
    stage.play().scene.objects.back().world_from_model =
        glm::translate(glm::mat4(1.0f), glm::vec3(meeting.person, 0.0f));
    Camera camera;
    camera.vertical_fov = 0.75f;
    camera.world_from_camera = look_at(meeting.eye, bonnet.centre());
    const reference::PixelWindow window = window_of_bonnet(camera, w, h);
    scene::Object& person = stage.play().scene.objects.back();
    person.is_visible = false;
    const reference::TracedPicture empty = stage.trace(camera, w, h, samples_per_pixel, window);
    person.is_visible = true;
    const reference::TracedPicture truth = stage.trace(camera, w, h, samples_per_pixel, window);
    const Image8 expected = shading::tone_mapped_picture(truth.radiance, stage.scene().exposure);
    const Image8 mask = changed_pixels(
        expected, shading::tone_mapped_picture(empty.radiance, stage.scene().exposure), truth.mirror_mask);
    for (std::size_t m = 0; m < methods->size(); ++m) {
      const JudgedMethod& method = (*methods)[m];
      const Result<double> flip =
          flip_between(picture_of(stage, method, camera, w, h, window), expected, mask);
      if (!flip) return flip.errors();
      report.note(fmt::format("a person at {:.2f} {:.2f}: FLIP in the bonnet {:.4f} {}", meeting.person.x,
                              meeting.person.y, *flip, method.name));
      sums[m] += *flip;
    }
  }
  report.add("bonnet_flip_over_mem", sums[0] / sums[1]);
  return Done{};
}

}  // namespace parvis::bench
