#include "scene/data/lamp.h"

#include "scene/data/name_pattern.h"
#include "scene/data/scene.h"

namespace parvis::scene {

bool burns(const Scene& scene, const Lamp& lamp) {
  if (lamp.burns != LampSwitch::dusk) return lamp.burns == LampSwitch::always;
  return scene.data<Darkness>().is_dark;
}

void show_what_lamps_show(Scene& scene) {
  for (const Lamp& lamp : scene.items<Lamp>())
    if (!lamp.shows.empty())
      for (Object& object : scene.objects)
        if (matches(lamp.shows, object.name)) object.is_visible = burns(scene, lamp);
}

}  // namespace parvis::scene
