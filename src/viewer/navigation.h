// Motion of the visitor: walks on the ground, flies, or follows an object. Independent of the window, so that
// tests can drive it.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "base/camera.h"

namespace parvis::viewer {

/// How the visitor moves.
enum class Mode { walk, fly, follow };

/// User input, accumulated since the last step.
struct Controls {
  glm::vec3 move{0.0f};  ///< forward, left, up: -1..1
  glm::vec2 turn{0.0f};  ///< radians: to the left, upward
  float zoom = 0.0f;     ///< steps of the wheel: changes speed, or distance when following
  bool hurries = false;
};

/// Pose of the visitor in the world: z up; heading 0 looks along +x, counter-clockwise from above.
class Navigation {
 public:
  explicit Navigation(const Camera& start);

  /// Jumps to a camera's pose and takes over its field of view; ends following.
  void go_to(const Camera& camera);
  /// Changes how the visitor moves; resets the speed that the wheel has set.
  void set_mode(Mode mode);
  Mode mode() const { return mode_; }  ///< at present

  /// Moves for `seconds`. When following, `target` is world_from_model of the followed object; walking keeps
  /// the present eye height.
  void step(const Controls& controls, float seconds, const glm::mat4& target);

  /// The present camera; looks at the followed object when following.
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
