// What the script says about local maps.
#pragma once

#include <array>

#include "reflections/methods/settings.h"

namespace parvis::local_maps {

/// The data of local maps that are shown in place of reflections, to look into them.
enum class LocalMapView : std::uint8_t {
  radiance,  ///< nothing else
  mesh,      ///< of local maps, in red
  weights    ///< of the two reference maps, red and green; blue where neither sees what is mirrored
};
inline constexpr std::array local_map_view_names{"radiance", "mesh", "weights"};

/// Settings of the method local_environment_maps.
struct LocalMapSettings {
  static constexpr std::string_view name = "local_maps.settings";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  LocalMapView shown = LocalMapView::radiance;

  /// Adds all of it.
  void hash(ContentHash& hash) const { hash.add(shown); }
};

}  // namespace parvis::local_maps
