// Traffic figures of roads, as the node trafficCount gives them.
#pragma once

#include <array>
#include <string>

#include "life/propagation/road_emission.h"
#include "scene/data/room_data.h"

namespace parvis::noise {

/// The periods of Lden: day (12 h), evening (4 h), night (8 h).
inline constexpr std::size_t periods = 3;

/// Counted vehicles of the roads whose names match.
struct TrafficCount {
  static constexpr std::string_view name = "noise.traffic_count";
  static constexpr scene::DataRole role = scene::DataRole::settings;  // heard, not seen
  std::string road;                             ///< name of roads; * and ? stand for other text
  std::array<double, periods> per_hour{};       ///< vehicles per hour in both directions
  std::array<double, periods> heavy_percent{};  ///< of them, lorries and buses
  double speed_km_h = 0.0;                      ///< 0: the road's limit
  std::string surface = "reference";            ///< a name of `surface_names`

  /// Adds all members; see SceneData.
  void hash(ContentHash& hash) const {
    hash.add_text(road), hash.add_text(surface);
    for (std::size_t i = 0; i < periods; ++i) hash.add(per_hour[i]), hash.add(heavy_percent[i]);
    hash.add(speed_km_h);
  }
};

/// Surfaces that `surface` may name.
inline constexpr std::array surface_names{"reference", "quiet asphalt", "setts"};

/// The surface of one of the names.
propagation::RoadSurface surface_named(const std::string& name);

}  // namespace parvis::noise
