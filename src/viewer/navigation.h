// How a visitor moves: walks on the ground, flies, or stays with an object. Pure motion, without a window, so
// that tests can drive it.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "base/camera.h"

namespace parvis::viewer {

enum class Mode { walk, fly, follow };

/// What the visitor's hands do, summed since the last step.
struct Controls {
  glm::vec3 move{0.0f};  ///< forward, left, up: -1..1
  glm::vec2 turn{0.0f};  ///< radians: to the left, upward
  float zoom = 0.0f;     ///< steps of the wheel: changes speed, or distance when following
  bool hurries = false;
};

/// A visitor in the world: z up, heading 0 looks along +x, counter-clockwise from above.
class Navigation {
 public:
  explicit Navigation(const Camera& start);

  /// Goes on from another place.
  void go_to(const Camera& camera);
  void set_mode(Mode mode);
  Mode mode() const { return mode_; }

  /// Moves for `seconds`. When following, `target` is the followed object's world_from_model; walking keeps
  /// the eye's height over the ground at which walking began.
  void step(const Controls& controls, float seconds, const glm::mat4& target);

  Camera camera() const;

 private:
  glm::vec3 looks() const;

  Camera lens_;  ///< field of view, near and far
  Mode mode_ = Mode::walk;
  glm::vec3 position_;
  float heading_ = 0.0f, pitch_ = 0.0f;
  float speed_factor_ = 1.0f;
  float follow_distance_m_ = 9.0f;
  glm::vec3 follow_target_{0.0f};
};

}  // namespace parvis::viewer
