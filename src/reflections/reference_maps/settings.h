// Where and how reference maps are taken, as far as the script says.
#pragma once

#include <vector>

#include "reflections/methods/settings.h"
#include "scene/script/node.h"

namespace parvis::reference_maps {

/// Settings, by the node `reflection`, of the methods that look reference maps up.
struct MapSettings {
  static constexpr std::string_view name = "reference_maps.settings";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  int max_maps = 240;  ///< that place themselves along the streets

  /// Adds all of it.
  void hash(ContentHash& hash) const { hash.add(max_maps); }
};

/// The node `referenceMaps`.
struct ReferenceMapPlan {
  static constexpr std::string_view name = "reference_maps.plan";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  std::vector<glm::vec3> places = {};  ///< in the world; empty: they place themselves
  int max_maps = 0, resolution = 0;    ///< 0: as the node `reflection` has them
  float cell_m = 1.0f;                 ///< of the heights that mirror rays are traced in
  float memory_mb = 1024.0f;           ///< for the maps that are held at once
  bool is_compressed = false;

  /// Adds all of it.
  void hash(ContentHash& hash) const {
    hash.add(places);
    for (const int value : {max_maps, resolution, int(is_compressed)}) hash.add(value);
    for (const float value : {cell_m, memory_mb}) hash.add(value);
  }
};

/// The node's plan, to be changed.
inline ReferenceMapPlan& map_plan(scene::Scene& scene) { return scene.data<ReferenceMapPlan>(); }
/// The node's plan.
inline const ReferenceMapPlan& map_plan(const scene::Scene& scene) { return scene.data<ReferenceMapPlan>(); }

/// How many maps place themselves, at most.
inline int max_maps(const scene::Scene& scene) {
  const int planned = map_plan(scene).max_maps;
  return planned ? planned : methods::own_settings<MapSettings>(scene).max_maps;
}

/// Edge of a cube map's face that is as sharp as the scene's reference maps, in pixels.
inline int map_resolution(const scene::Scene& scene) {
  const int planned = map_plan(scene).resolution;
  return planned ? planned : methods::settings(scene).resolution;
}

/// The attribute `maps` of the node `reflection`, of every method that looks reference maps up.
scene::AttributeSchema maps_attribute();
/// Takes its value over into MapSettings.
void read_maps(const scene::Node& node, methods::Settings& settings);

}  // namespace parvis::reference_maps
