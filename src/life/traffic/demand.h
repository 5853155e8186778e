// Which traffic a scene asks for.
#pragma once

#include <memory>
#include <vector>

#include "scene/data/model.h"
#include "scene/data/room_data.h"

namespace parvis::traffic {

/// Vehicles to be put on the scene's roads; they keep to its scene::DrivingArea.
struct TrafficDemand {
  static constexpr std::string_view name = "traffic.demand";
  static constexpr scene::DataRole role =
      scene::DataRole::settings;  // pictures show the vehicles, which are objects
  int vehicles = 0;
  std::uint64_t seed = 1;
  std::vector<std::shared_ptr<const scene::Model>>
      models;              ///< x forward, wheels as nodes whose names hold "wheel"
  bool is_visible = true;  ///< hidden vehicles drive on
  int bicycles = 0;        ///< beside the vehicles

  void hash(ContentHash& hash) const {
    hash.add(vehicles);
    hash.add(bicycles);
    hash.add(seed);
    hash.add(is_visible);
    for (const auto& model : models) hash.add_text(model->name), hash.add(model->triangle_count());
  }
};

}  // namespace parvis::traffic
