// Mirrors show the light that surfaces give back to each other, by every method of reflection.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "graphics/gl/test_context.h"
#include "graphics/render/light_source.h"
#include "graphics/render/test_room.h"
#include "reflections/methods/frame.h"
#include "reflections/methods/settings.h"
#include "reflections/reference_maps/settings.h"
#include "rooms/rooms.h"
#include "scene/data/bounced_settings.h"
#include "scene/data/test_scene.h"

namespace parvis::rooms {
namespace {

constexpr int width = 96, height = 72;
constexpr int frames_per_method = 4;  // some methods draw a part of their maps in each
constexpr glm::vec3 mirror_at{2.5f, 0.0f, 1.6f};

/// A street in white sun and without a sky, whose western wall is red and in its own shadow: all that is red
/// is light that this wall gives back. A mirror shows the wall. There is ground in the street alone, so that
/// maps which find their places by themselves lie there, too.
scene::Scene street(bool is_bounced) {
  scene::Scene scene;
  const scene::Material grey = scene::matt(glm::vec3(0.5f));
  const auto add = [&](const Mesh& mesh, const scene::Material& material) {
    scene::add(scene, scene::model_of(mesh, material));
  };
  add(scene::quad({-6, -16, 0}, {6, -16, 0}, {6, 16, 0}, {-6, 16, 0}), grey);
  add(scene::box({-14, -16, 0}, {-6, 16, 12}), scene::matt(glm::vec3(0.8f, 0.3f, 0.2f)));
  add(scene::box({-14, -16, 12}, {-6, 16, 12.5f}), grey);  // its roof
  add(scene::box({6, -16, 0}, {14, 16, 12}), grey);
  render::add_mirror(scene, mirror_at, 1.2f);
  scene.sun.direction_to_sun = glm::normalize(glm::vec3(-0.5f, 0.1f, 0.9f));
  scene.sun.irradiance = glm::vec3(8.0f), scene.sky.intensity = 0.0f;
  scene.data<scene::BouncedSettings>() = {is_bounced, 4.0f, 64};
  return scene;
}

/// The red in the mirror beyond grey, summed over its pixels: by a method, and by rays.
struct Shown {
  double by_method, by_rays;
};

Shown red_in_the_mirror(const std::string& method, bool is_bounced) {
  scene::Scene scene = street(is_bounced);
  methods::settings(scene) = {method, 64, false};
  methods::own_settings<reference_maps::MapSettings>(scene).max_maps = 4;
  EXPECT_TRUE(method_registry().prepare(scene));
  auto renderer = render::Renderer::create(scene, {}, all_registries().get<render::Lights>().make);
  EXPECT_TRUE(renderer) << to_string(renderer.errors());
  const auto reflections = method_registry().make(scene, **renderer);
  EXPECT_TRUE(reflections) << to_string(reflections.errors());
  EXPECT_TRUE((*renderer)->set_reflection(reflections->get()));
  Camera camera;
  camera.world_from_camera = look_at({-3.5f, -3.0f, 1.8f}, mirror_at);
  const render::EyeView eye{camera, width, height};
  for (int frame = 0; frame < frames_per_method; ++frame)
    EXPECT_TRUE(methods::draw_frame(**renderer, scene, reflections->get(), eye));
  const ImageF drawn = (*renderer)->read_radiance();
  const reference::TracedPicture traced = methods::trace_frame(**renderer, scene, eye);
  Shown shown{0.0, 0.0};
  int pixels = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (*traced.mirror_mask.at(x, y) != 255) continue;
      const float *by_method = drawn.at(x, y), *by_rays = traced.radiance.at(x, y);
      shown.by_method += double(by_method[0] - by_method[2]),
          shown.by_rays += double(by_rays[0] - by_rays[2]);
      ++pixels;
    }
  EXPECT_GT(pixels, 500) << "the mirror is in the picture";
  return shown;
}

class BouncedInMirrors : public gl::ContextTest {};

TEST_F(BouncedInMirrors, EveryMethodShowsWhatRaysShow) {
  for (const std::string& method : method_registry().names()) {
    if (method == "none") continue;
    const Shown with = red_in_the_mirror(method, true), without = red_in_the_mirror(method, false);
    std::printf("%s: %.2f of the red that rays show, %.2f without bounced light\n", method.c_str(),
                with.by_method / with.by_rays, without.by_method / with.by_rays);
    EXPECT_LT(std::abs(without.by_rays), 0.01 * with.by_rays) << "the control: it is bounced light";
    // Methods show the wall from places that are not quite that of the mirror.
    EXPECT_NEAR(with.by_method / with.by_rays, 1.0, 0.2) << method;
    EXPECT_LT(std::abs(without.by_method), 0.05 * with.by_rays) << method;
  }
}

}  // namespace
}  // namespace parvis::rooms
