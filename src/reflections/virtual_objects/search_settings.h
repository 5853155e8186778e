// How virtual objects find the reflection points of their vertices: what the node `reflection` says of it.
#pragma once

#include <array>

#include "reflections/methods/settings.h"

namespace parvis::virtual_objects {

/// How the reflection point of a vertex is searched for.
enum class SearchMethod : std::uint8_t { newton, midpoint };
inline constexpr std::array search_method_names{"newton", "midpoint"};

/// The search for reflection points.
struct SearchSettings {
  static constexpr std::string_view name = "virtual_objects.search";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  float grid_share = 1.0f;  ///< max. corners of a virtual grid, per vertex of its mesh; 1: each vertex itself
  SearchMethod search = SearchMethod::newton;
  int iterations = 9;  ///< of the midpoint search

  /// Adds all of it.
  void hash(ContentHash& hash) const {
    hash.add(grid_share);
    hash.add(search);
    hash.add(iterations);
  }
};

/// The scene's settings, to be changed.
inline SearchSettings& search_settings(scene::Scene& scene) {
  return methods::own_settings<SearchSettings>(scene);
}
/// The scene's settings.
inline const SearchSettings& search_settings(const scene::Scene& scene) {
  return methods::own_settings<SearchSettings>(scene);
}

}  // namespace parvis::virtual_objects
