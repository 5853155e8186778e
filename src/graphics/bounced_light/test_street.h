// A street for the tests of this room.
#pragma once

#include "graphics/shading/sky.h"
#include "scene/data/bounced_settings.h"
#include "scene/data/test_scene.h"

namespace parvis::bounced_light {

/// A narrow street whose eastern wall is in the sun, the western one, red, in its own shadow.
inline scene::Scene street() {
  scene::Scene scene;
  add(scene, scene::model_of(scene::ground(40), scene::matt(glm::vec3(0.4f))));
  add(scene,
      scene::model_of(scene::box({-14, -30, 0}, {-6, 30, 12}), scene::matt(glm::vec3(0.7f, 0.3f, 0.2f))));
  add(scene, scene::model_of(scene::box({6, -30, 0}, {14, 30, 12}), scene::matt(glm::vec3(0.7f))));
  scene.sun.direction_to_sun = glm::normalize(glm::vec3(-0.5f, 0.1f, 0.9f));
  scene.sun.irradiance = glm::vec3(9.0f, 8.5f, 7.5f);
  scene.data<scene::BouncedSettings>() = {true, 3.0f, 128};
  return scene;
}

/// The sky of a scene as a renderer takes it.
inline shading::SkyLight sky_of(const scene::Scene& scene) {
  return shading::make_sky_light(scene.sky.picture, scene.sky.intensity, scene.sky.heading);
}

}  // namespace parvis::bounced_light
