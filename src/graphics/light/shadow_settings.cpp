#include "graphics/light/shadow_settings.h"

namespace parvis::light {

void ShadowSettings::hash(ContentHash& hash) const {
  hash.add(technique);
  hash.add(updates_near);
  hash.add(sun_samples);
  hash.add(to_light.value_or(glm::vec3(0.0f)));
}

void set_sun(scene::Scene& scene, const scene::Sun& sun) {
  scene.data<ShadowSettings>().own_sun = sun;
  replace_sun(scene);
}

void replace_sun(scene::Scene& scene) {
  ShadowSettings& settings = scene.data<ShadowSettings>();
  if (!settings.own_sun) settings.own_sun = scene.sun;
  scene.sun = *settings.own_sun;
  if (settings.to_light) scene.sun.direction_to_sun = *settings.to_light;
}

}  // namespace parvis::light
