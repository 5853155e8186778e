// The lanes on which vehicles drive: polylines joined at their ends. Generated, scripted, or imported from a
// city model.
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "scene/data/room_data.h"

namespace parvis::scene {

/// One direction of travel. Turns through a crossing are lanes too.
struct Lane {
  std::vector<glm::vec3> points;  ///< centre line on the ground, metres, at least two
  std::vector<int> next;          ///< lanes that begin where this one ends
  float width_m = 3.0f;
  float speed_limit = 13.9f;  ///< m/s
  int crossing = -1;          ///< the crossing that a turning lane passes through, else -1
};

/// The lanes of a scene; Lane::next holds indices into `lanes`.
struct RoadGraph {
  std::vector<Lane> lanes;

  /// True if there are no lanes.
  bool empty() const { return lanes.empty(); }
};

/// The part of the city in which vehicles drive: streets within `radius_m` of `centre` (metres, in plan) that
/// lead on.
struct DrivingArea {
  static constexpr std::string_view name = "roads.driving_area";
  static constexpr DataRole role = DataRole::settings;
  glm::vec2 centre{0.0f};
  float radius_m = std::numeric_limits<float>::max();

  /// True if the point is less than `radius_m` + `beyond_rim_m` from the centre.
  bool contains(glm::vec2 point, float beyond_rim_m = 0.0f) const {
    return glm::distance(point, centre) < radius_m + beyond_rim_m;
  }
  /// Adds all members; see SceneData.
  void hash(ContentHash& hash) const {
    hash.add(centre);
    hash.add(radius_m);
  }
};

}  // namespace parvis::scene
