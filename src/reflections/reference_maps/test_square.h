// Places for this room's tests: a square among towers that shine by themselves, judged by the ray tracer.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/metrics.h"
#include "graphics/render/test_room.h"
#include "graphics/shading/tone_curve.h"
#include "reflections/methods/frame.h"
#include "reflections/methods/reflections.h"
#include "reflections/reference_maps/settings.h"

namespace parvis::reference_maps {

inline constexpr int test_width = 320, test_height = 240;

/// Black metal: nothing but its own light.
inline scene::Material lamp(glm::vec3 colour) {
  scene::Material lamp = scene::matt(glm::vec3(0.0f));
  lamp.metallic = 1.0f;
  lamp.emission = colour;
  return lamp;
}

/// A square with towers in colours of their own, and a mirror box between them.
inline scene::Scene tower_square() {
  scene::Scene scene;
  scene.sun.irradiance = glm::vec3(0.0f);
  scene::add(scene, scene::model_of(scene::ground(60.0f), scene::matt(glm::vec3(0.4f))));
  const auto tower = [&](glm::vec2 corner, glm::vec3 size, glm::vec3 colour) {
    const glm::vec3 low(corner, 0.0f);
    scene::add(scene, scene::model_of(scene::box(low, low + size), lamp(colour)));
  };
  tower({-20, -6}, {6, 4, 14}, {0.9f, 0.1f, 0.1f});
  tower({-20, 2}, {6, 8, 9}, {0.1f, 0.8f, 0.1f});
  tower({-4, 14}, {10, 6, 11}, {0.1f, 0.2f, 0.9f});
  tower({14, 3}, {6, 9, 7}, {0.9f, 0.8f, 0.1f});
  tower({13, -12}, {5, 8, 16}, {0.1f, 0.8f, 0.8f});
  tower({-6, -20}, {14, 6, 10}, {0.8f, 0.1f, 0.8f});
  render::add_mirror(scene, {1.5f, 0.5f, 1.6f}, 1.2f);
  methods::settings(scene) = {"multiple_environment_maps", 128, false};
  methods::own_settings<MapSettings>(scene).max_maps = 12;
  return scene;
}

using MakeReflections = std::function<Result<std::unique_ptr<methods::Reflections>>(
    const scene::Scene&, render::Renderer&, std::unique_ptr<methods::Reflections>)>;

/// FLIP inside the mirrors, seen from `eye`, against the ray tracer. No method: they show the sky alone.
inline double flip_of(const scene::Scene& scene, const MakeReflections& make, glm::vec3 eye) {
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene, {}, light::sun_and_sky);
  EXPECT_TRUE(renderer) << to_string(renderer.errors());
  std::unique_ptr<methods::Reflections> reflections;
  Camera camera;
  camera.world_from_camera = look_at(eye, {1.5f, 0.5f, 1.6f});
  if (make) {
    Result<std::unique_ptr<methods::Reflections>> made = make(scene, **renderer, nullptr);
    EXPECT_TRUE(made) << to_string(made.errors());
    reflections = *std::move(made);
    const Status set = (*renderer)->set_reflection(reflections.get());
    EXPECT_TRUE(set) << to_string(set.errors());
  }
  const render::EyeView view{camera, test_width, test_height};
  EXPECT_TRUE(methods::draw_frame(**renderer, scene, reflections.get(), view));
  const Image8 drawn = (*renderer)->read_picture(scene.exposure);
  const reference::TracedPicture truth = methods::trace_frame(**renderer, scene, view);
  const Result<reference::Difference> difference = reference::compare(
      drawn, shading::tone_mapped_picture(truth.radiance, scene.exposure), truth.mirror_mask);
  EXPECT_TRUE(difference) << to_string(difference.errors());
  return difference->flip;
}

}  // namespace parvis::reference_maps
