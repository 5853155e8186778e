// Where vehicles may drive: lanes as polylines, joined at their ends. Generated, scripted, or taken from a
// city model.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace parvis::scene {

/// One direction of travel. Turns through a crossing are lanes too.
struct Lane {
  std::vector<glm::vec3> points;  ///< centre line on the ground, metres, at least two
  std::vector<int> next;          ///< lanes that begin where this one ends
  float width_m = 3.0f;
  float speed_limit = 13.9f;  ///< m/s
  int crossing = -1;          ///< the crossing that a turning lane passes through, else -1
};

struct RoadGraph {
  std::vector<Lane> lanes;

  bool empty() const { return lanes.empty(); }
};

}  // namespace parvis::scene
