// Mirrors in mirrors, and a person in a bonnet.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>

#include "base/colour.h"
#include "bench/parts.h"
#include "bench/reflections/judged_method.h"
#include "graphics/gl/context.h"
#include "graphics/shading/tone_curve.h"
#include "places/paper_city/car.h"
#include "places/paper_city/mirror_bodies.h"
#include "places/paper_city/walker.h"
#include "reflections/reference_maps/settings.h"
#include "reflections/reflector_maps/settings.h"
#include "scene/data/test_scene.h"

namespace parvis::bench {
namespace {

Image8 changed_pixels(const Image8& with, const Image8& without, const Image8& mirrors) {
  constexpr int min_change = 3, margin_px = 3;
  Image8 mask(with.width, with.height, 1, 0);
  for (int y = 0; y < with.height; ++y)
    for (int x = 0; x < with.width; ++x) {
      int change = 0;
      for (int c = 0; c < 3; ++c) change = std::max(change, std::abs(with.at(x, y)[c] - without.at(x, y)[c]));
      if (change < min_change || *mirrors.at(x, y) < 128) continue;
      for (int v = std::max(y - margin_px, 0); v <= std::min(y + margin_px, with.height - 1); ++v)
        for (int u = std::max(x - margin_px, 0); u <= std::min(x + margin_px, with.width - 1); ++u)
          if (*mirrors.at(u, v) >= 128) *mask.at(u, v) = 255;
    }
  return mask;
}

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

/// The ray tracer's picture of a view with as many bounces.
reference::TracedPicture truth_of(stage::Stage& stage, const Camera& camera, glm::ivec2 size, int bounces) {
  methods::settings(stage.simulation().scene).bounces = bounces;
  return stage.trace(camera, size.x, size.y, samples_per_pixel);
}

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

void measure_two_bounces(const BenchSetup& setup, Report& report) {
  const glm::ivec2 size = setup.is_quick ? glm::ivec2(480, 360) : glm::ivec2(960, 720);
  const auto made = stage_of(mirrors_among_boxes());
  stage::Stage& stage = *made;
  const methods::Settings twice = methods::settings(stage.scene());
  methods::Settings once = twice;
  once.bounces = 1;
  const std::vector<JudgedMethod> methods =
      judged_methods(stage, {{"two bounces", twice},
                             {"one bounce", once},
                             {"re-rendered cube maps", rerendered_baseline(stage.scene())}});
  std::array<double, 3> in_mirrors{}, in_mirrors_in_mirrors{};
  for (const Place& place : places) {
    Camera camera;
    camera.world_from_camera = look_at(place.eye, place.target);
    const reference::TracedPicture truth = truth_of(stage, camera, size, 2);
    const auto toned = [&](const reference::TracedPicture& picture) {
      return shading::tone_mapped_picture(picture.radiance, stage.scene().exposure);
    };
    const Image8 expected = toned(truth);
    const Image8 twice_mirrored =
        changed_pixels(expected, toned(truth_of(stage, camera, size, 1)), truth.mirror_mask);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const Image8 picture = picture_of(stage, methods[m], camera, size);
      const double flip = flip_between(picture, expected, truth.mirror_mask),
                   flip_twice = flip_between(picture, expected, twice_mirrored);
      in_mirrors[m] += flip / places.size();
      in_mirrors_in_mirrors[m] += flip_twice / places.size();
    }
  }
  for (std::size_t m = 0; m < methods.size(); ++m)
    report.note(fmt::format("{}: FLIP {:.4f} inside mirrors, {:.4f} where they show mirrors", methods[m].name,
                            in_mirrors[m], in_mirrors_in_mirrors[m]));
  report.add("two_bounce_flip_over_rerendered", in_mirrors_in_mirrors[0] / in_mirrors_in_mirrors[2]);
  report.add("two_bounce_flip_over_rerendered_of_one_bounce",
             in_mirrors_in_mirrors[1] / in_mirrors_in_mirrors[2]);
  report.add("two_bounce_flip_in_all_mirrors", in_mirrors[0] / in_mirrors[2]);
}

void measure_bonnet(const BenchSetup& setup, Report& report) {
  const glm::ivec2 size = setup.is_quick ? glm::ivec2(640, 400) : glm::ivec2(960, 600);
  const auto made = stage_of(street());
  stage::Stage& stage = *made;
  methods::Settings near = methods::settings(stage.scene());
  near.own.get<reflector_maps::NearObjectSettings>().within_m = virtual_within_m;
  const std::vector<JudgedMethod> methods =
      judged_methods(stage, {{"with virtual objects", near}, {"maps", methods::settings(stage.scene())}});
  std::array<double, 2> sums{};
  for (const Meeting& meeting : meetings) {
    stage.simulation().scene.objects.back().world_from_model =
        glm::translate(glm::mat4(1.0f), glm::vec3(meeting.person, 0.0f));
    Camera camera;
    camera.vertical_fov = 0.75f;
    camera.world_from_camera = look_at(meeting.eye, bonnet.centre());
    const reference::PixelWindow window = window_of_bonnet(camera, size.x, size.y);
    scene::Object& person = stage.simulation().scene.objects.back();
    person.is_visible = false;
    const reference::TracedPicture empty = stage.trace(camera, size.x, size.y, samples_per_pixel, window);
    person.is_visible = true;
    const reference::TracedPicture truth = stage.trace(camera, size.x, size.y, samples_per_pixel, window);
    const Image8 expected = shading::tone_mapped_picture(truth.radiance, stage.scene().exposure);
    const Image8 mask = changed_pixels(
        expected, shading::tone_mapped_picture(empty.radiance, stage.scene().exposure), truth.mirror_mask);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const JudgedMethod& method = methods[m];
      const double flip = flip_between(picture_of(stage, method, camera, size, window), expected, mask);
      report.note(fmt::format("a person at {:.2f} {:.2f}: FLIP in the bonnet {:.4f} {}", meeting.person.x,
                              meeting.person.y, flip, method.name));
      sums[m] += flip;
    }
  }
  report.add("bonnet_flip_over_mem", sums[0] / sums[1]);
}

}  // namespace parvis::bench
