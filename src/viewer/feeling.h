// What the hand on a gamepad or wand feels of a visit: the haptic nodes of its scene.
#pragma once

#include "planning/devices/devices.h"
#include "viewer/planning.h"

namespace parvis::viewer {

class Feeling {
 public:
  /// Whether the scene has something to be felt.
  static bool is_in(const scene::Scene& scene);
  /// Plays the nodes of what has happened in a frame: since the eye stood at `stood`, it was to move by
  /// `controls` for `seconds`. Null devices feel nothing.
  void step(Visit& visit, Planning& planning, const Controls& controls, glm::vec3 stood, float seconds,
            devices::Devices* devices);

 private:
  std::array<bool, devices::felt_names.size()> is_felt_{};  ///< in the last frame
  std::size_t selected_ = 0;
};

}  // namespace parvis::viewer
