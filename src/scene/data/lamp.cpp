#include "scene/data/lamp.h"

#include <unordered_map>

#include "scene/data/name_pattern.h"
#include "scene/data/scene.h"

namespace parvis::scene {

bool burns(const Scene& scene, const Lamp& lamp) {
  if (lamp.burns != LampSwitch::dusk) return lamp.burns == LampSwitch::always;
  return scene.data<Darkness>().is_dark;
}

void show_what_lamps_show(Scene& scene) {
  // Of lamps that show the same objects the last one decides; streets have hundreds of them.
  struct Shown {
    std::size_t order;
    bool is_burning;
  };
  std::unordered_map<std::string_view, Shown> by_name, by_pattern;
  std::size_t order = 0;
  for (const Lamp& lamp : scene.items<Lamp>())
    if (!lamp.shows.empty())
      (is_pattern(lamp.shows) ? by_pattern : by_name)[lamp.shows] = {++order, burns(scene, lamp)};
  if (order == 0) return;
  for (Object& object : scene.objects) {
    Shown last{0, false};
    if (const auto named = by_name.find(object.name); named != by_name.end()) last = named->second;
    for (const auto& [pattern, shown] : by_pattern)
      if (shown.order > last.order && matches(pattern, object.name)) last = shown;
    if (last.order > 0) object.is_visible = last.is_burning;
  }
}

}  // namespace parvis::scene
