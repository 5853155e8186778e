// Stops of vehicles that people board, while a scene runs: buses and trams write where they stand with open
// doors, and people write who is still on the way to these.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "base/content_hash.h"
#include "scene/data/room_data.h"

namespace parvis::scene {

/// A platform and what stands at it.
struct TransitStop {
  glm::vec3 from{0.0f}, to{0.0f};  ///< ends of its edge beside the vehicle, on its surface
  glm::vec2 away{0, 1};            ///< unit vector from the vehicle onto the platform
  float breadth_m = 2.5f;
  std::vector<glm::vec3> doors;   ///< of a vehicle that stands here, on the edge
  bool is_open = false;           ///< they are open, now
  float open_s = 0.0f;            ///< until they close, if nobody is on the way to them
  int boarding = 0;               ///< people on the way to them or out of them: they stay open
  int boarded = 0, alighted = 0;  ///< people, since the scene began
};

/// The stops of a running scene; null before it begins, or where it has none.
struct SharedStops {
  static constexpr std::string_view name = "roads.shared_stops";
  static constexpr DataRole role =
      DataRole::settings;  // pictures show vehicles and people, which are objects
  std::shared_ptr<std::vector<TransitStop>> now;

  /// Adds nothing: the state of a moment; see SceneData.
  void hash(ContentHash&) const {}
};

}  // namespace parvis::scene
