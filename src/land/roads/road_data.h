// What the nodes road, streets and paving keep in a scene.
#pragma once

#include "base/content_hash.h"
#include "scene/data/road.h"
#include "scene/data/room_data.h"

namespace parvis::scene {

/// A road of the script, in the world. Its lanes are built by the finish step.
struct PlannedRoad {
  static constexpr std::string_view name = "roads.planned_road";
  static constexpr DataRole role = DataRole::settings;  // pictures show its paving, which is an object
  Road road;

  /// Adds the road's geometry and lanes; see SceneData.
  void hash(ContentHash& hash) const {
    hash.add(road.path);
    for (const float value : {road.lane_width_m, road.speed_limit}) hash.add(value);
    for (const int value : {road.lanes_each_way, road.lanes_back, int(road.is_one_way)}) hash.add(value);
  }
};

/// Whether carriageways are generated along the lanes.
struct Paving {
  static constexpr std::string_view name = "roads.paving";
  static constexpr DataRole role = DataRole::settings;
  bool is_laid = false;

  /// Adds `is_laid`; see SceneData.
  void hash(ContentHash& hash) const { hash.add(is_laid); }
};

}  // namespace parvis::scene
