// Which objects curved reflectors show by virtual objects: by images of their own, each vertex at its
// reflection point.
#pragma once

#include <array>

#include "reflections/methods/settings.h"

namespace parvis::reflector_maps {

/// The method by which reflectors show all objects so.
inline constexpr const char* virtual_objects_method = "virtual_objects";

/// How the reflection point of a vertex is searched for.
enum class SearchMethod : std::uint8_t { newton, midpoint };
inline constexpr std::array search_method_names{"newton", "midpoint"};

/// How virtual objects are shown, by the node `reflection`.
struct VirtualObjectSettings {
  static constexpr std::string_view name = "reflector_maps.virtual_objects";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  float within_m = 0.0f;    ///< by other methods: what stands wholly so near to a mirror is shown so, too
  float grid_share = 1.0f;  ///< max. corners of a virtual grid, per vertex of its mesh; 1: each vertex itself
  SearchMethod search = SearchMethod::newton;
  int iterations = 9;  ///< of the midpoint search

  /// Adds all of it.
  void hash(ContentHash& hash) const {
    for (const float value : {within_m, grid_share}) hash.add(value);
    hash.add(search);
    hash.add(iterations);
  }
};

/// What the scene says, to be changed.
inline VirtualObjectSettings& virtual_settings(scene::Scene& scene) {
  return methods::own_settings<VirtualObjectSettings>(scene);
}
/// What the scene says.
inline const VirtualObjectSettings& virtual_settings(const scene::Scene& scene) {
  return methods::own_settings<VirtualObjectSettings>(scene);
}

/// Are all objects shown so?
inline bool shows_all_objects(const scene::Scene& scene) {
  return methods::settings(scene).method == virtual_objects_method;
}
/// Are those that stand near, by another method?
inline bool shows_near_objects(const scene::Scene& scene) {
  return !shows_all_objects(scene) && virtual_settings(scene).within_m > 0.0f;
}

}  // namespace parvis::reflector_maps
