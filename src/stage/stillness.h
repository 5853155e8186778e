// Whether a view and what it shows stand still.
#pragma once

#include <cstdint>
#include <vector>

#include "base/camera.h"
#include "scene/data/scene.h"

namespace parvis::stage {

/// A hash of all that a frame shows and that may change while a scene runs; without the objects that `shown`
/// leaves out (a flag for each; null: all are shown).
std::uint64_t state_of(const scene::Scene& scene, const Camera& camera, int width, int height,
                       const std::vector<std::uint8_t>* shown = nullptr);

/// Compares each frame with the one before it: the camera, the picture's size, and all of the scene that may
/// change while it runs.
class Stillness {
 public:
  /// Takes in the frame to come, `passed_s` after the last one.
  void add_frame(const scene::Scene& scene, const Camera& camera, int width, int height, double passed_s);

  /// Is it long enough that a visitor has stopped to look?
  bool rests() const { return still_s_ >= rests_from_s; }

 private:
  static constexpr double rests_from_s = 0.4;

  std::uint64_t state_ = 0;
  double still_s_ = 0.0;  ///< for how long nothing has changed; 0 in a frame that differs from the last
};

}  // namespace parvis::stage
