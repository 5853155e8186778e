// What a scene says about its reflections: the values of its node `reflection`.
#pragma once

#include <string>

#include "scene/data/scene.h"

namespace parvis::methods {

/// Settings of all methods, and of each room's methods beside them.
struct Settings {
  static constexpr std::string_view name = "methods.settings";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  std::string method = {};           ///< as scripts name it; empty: automatic
  int resolution = 128;              ///< pixels along the edge of a cube map's face
  bool uses_level_of_detail = true;  ///< resolution by size on screen; far objects share one map
  float budget_ms = 0.0f;            ///< of a frame, held by choosing levels of detail; 0: none
  int bounces = 1;                   ///< 2: mirrors show what mirrors show
  scene::RoomDataSet own = {};       ///< settings of single rooms, by type

  /// Adds all of it.
  void hash(ContentHash& hash) const;
};

/// Settings of a window, which no script gives. Pictures and films have the default, so that they can be
/// repeated.
struct Pace {
  static constexpr std::string_view name = "methods.pace";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  bool begins_at_once = false;  ///< a method that takes time to prepare begins with something cheaper

  /// Adds all of it.
  void hash(ContentHash& hash) const { hash.add(int(begins_at_once)); }
};

/// Compares by content.
bool operator==(const Settings& a, const Settings& b);

/// The scene's settings, to be changed.
inline Settings& settings(scene::Scene& scene) { return scene.data<Settings>(); }
/// The scene's settings.
inline const Settings& settings(const scene::Scene& scene) { return scene.data<Settings>(); }

/// The settings of a room's methods: a struct that scene::SceneData describes, of role `settings`.
template <scene::SceneData T>
T& own_settings(scene::Scene& scene) {
  return settings(scene).own.get<T>();
}
/// The same to read.
template <scene::SceneData T>
const T& own_settings(const scene::Scene& scene) {
  return settings(scene).own.get<T>();
}

}  // namespace parvis::methods
