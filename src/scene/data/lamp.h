// Lamps of a scene: street lamps, shop windows, headlights. Each has a place of its own, or stands on every
// object of some name and goes with it.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "base/content_hash.h"
#include "scene/data/room_data.h"

namespace parvis::scene {

struct Scene;

/// When a lamp burns.
enum class LampSwitch : std::uint8_t {
  dusk,  ///< while daylight is weak: Darkness
  always,
  never
};

/// One lamp, or one on each object whose name matches; nodes make any number.
struct Lamp {
  static constexpr std::string_view name = "data.lamps";
  static constexpr DataRole role = DataRole::static_content;

  std::string of;            ///< pattern of object names; empty: the lamp stands by itself
  std::string part;          ///< of the object's model: the lamp is in the middle of it; empty: at `position`
  std::string shows;         ///< pattern of names of objects that are seen only while it burns; empty: none
  glm::vec3 position{0.0f};  ///< in the world, or in the frame of the object that it stands on
  glm::vec3 axis{0.0f, 0.0f, -1.0f};  ///< unit, in the same frame
  float half_angle = 3.1415927f;      ///< of the cone about the axis, radians; pi: it shines all round
  glm::vec3 intensity{0.0f};          ///< W/sr, weighted by the eye as all light of the house
  float reach_m = 20.0f;              ///< beyond it there is no light
  float radius_m = 0.0f;              ///< what lies so near to the middle of the lamp shines: its glass
  LampSwitch burns = LampSwitch::dusk;

  /// Adds all members.
  void hash(ContentHash& hash) const {
    for (const std::string* text : {&of, &part, &shows}) hash.add_text(*text);
    for (const glm::vec3 value : {position, axis, intensity}) hash.add(value);
    for (const float value : {half_angle, reach_m, radius_m}) hash.add(value);
    hash.add(burns);
  }
};

/// How dark it is; written by the node that gives a scene its daylight.
struct Darkness {
  static constexpr std::string_view name = "data.darkness";
  static constexpr DataRole role = DataRole::settings;  ///< it follows from sun and sky

  bool is_dark = false;  ///< so that lamps are lit

  /// The flag.
  void hash(ContentHash& hash) const { hash.add(is_dark); }
};

/// Is the lamp lit now?
bool burns(const Scene& scene, const Lamp& lamp);

/// Shows and hides the objects of all Lamp::shows.
void show_what_lamps_show(Scene& scene);

}  // namespace parvis::scene
