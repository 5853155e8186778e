// A city at another hour.
#pragma once

#include "graphics/light/day_light.h"

namespace parvis::bench {

/// Gives a scene with dayLight the sun and sky of another hour of its day. Fails as light::light_scene.
inline Status set_hour(scene::Scene& scene, double hour) {
  scene.data<light::DayLight>().when.time_of_day_h = hour;
  return light::light_scene(scene);
}

}  // namespace parvis::bench
