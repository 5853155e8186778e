// Which objects curved reflectors show by images of their own, each vertex at its reflection point: in
// mirrors as in glass.
#pragma once

#include "reflections/methods/settings.h"

namespace parvis::reflector_maps {

/// The method by which reflectors show all objects so.
inline constexpr const char* virtual_objects_method = "virtual_objects";

/// Which objects are shown so by other methods.
struct NearObjectSettings {
  static constexpr std::string_view name = "reflector_maps.near_objects";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  float within_m = 0.0f;  ///< those that stand wholly so near to a mirror; 0: none

  /// Adds all of it.
  void hash(ContentHash& hash) const { hash.add(within_m); }
};

/// The scene's settings, to be changed.
inline NearObjectSettings& near_object_settings(scene::Scene& scene) {
  return methods::own_settings<NearObjectSettings>(scene);
}
/// The scene's settings.
inline const NearObjectSettings& near_object_settings(const scene::Scene& scene) {
  return methods::own_settings<NearObjectSettings>(scene);
}

/// Are all objects shown so?
inline bool shows_all_objects(const scene::Scene& scene) {
  return methods::settings(scene).method == virtual_objects_method;
}
/// Are those that stand near, by another method?
inline bool shows_near_objects(const scene::Scene& scene) {
  return !shows_all_objects(scene) && near_object_settings(scene).within_m > 0.0f;
}

}  // namespace parvis::reflector_maps
