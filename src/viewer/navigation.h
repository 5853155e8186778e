// Motion of the visitor: walks on the ground, flies, follows an object, or looks at a plan. Independent of
// the window, so that tests can drive it.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "base/camera.h"

namespace parvis::viewer {

/// How the visitor moves.
enum class Mode { walk, fly, follow, plan };

/// User input, accumulated since the last step.
struct Controls {
  glm::vec3 move{0.0f};  ///< forward, left, up: -1..1
  glm::vec2 turn{0.0f};  ///< radians: to the left, upward
  float zoom = 0.0f;     ///< steps of the wheel: changes speed, distance when following, scale of a plan
  /// Movement in a plan: how far it is drawn to the right and up, and the point that the wheel keeps in
  /// place, from the middle; both in heights of the picture.
  glm::vec2 pan{0.0f}, zoom_at{0.0f};
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

  /// Goes there within `seconds`, by a way that eases in and out and keeps the horizon level; any motion of
  /// the visitor ends it. Of a parallel camera: ends in its plan. `arrives_in`: how the visitor goes on
  /// there; not given: as at present, or flying where that is the plan.
  void fly_to(const Camera& camera, float seconds, std::optional<Mode> arrives_in = {});
  /// Is such a flight under way?
  bool is_flying_to() const { return flight_.has_value(); }
  /// Says where a step on foot ends: none, where walls or high steps stop it. Empty: nothing stops it, and
  /// the eye keeps its height.
  std::function<std::optional<glm::vec3>(glm::vec3 from, glm::vec3 to)> on_foot = {};

  /// Moves for `seconds`. When following, `target` is world_from_model of the followed object; walking keeps
  /// the present eye height.
  void step(const Controls& controls, float seconds, const glm::mat4& target);

  /// The present camera; looks at the followed object when following.
  Camera camera() const;

 private:
  /// The flight to a camera.
  struct Flight {
    glm::vec3 from, to;
    float heading_from, heading_to, pitch_from, pitch_to, fov_from;
    Camera camera;
    float passed_s, seconds;
    std::optional<Mode> arrives_in;
  };

  glm::vec3 looks() const;
  void step_flight(float seconds);
  void step_plan(const Controls& controls, float seconds);

  Camera lens_;  ///< field of view, near and far
  Mode mode_ = Mode::walk;
  glm::vec3 position_;
  float heading_ = 0.0f, pitch_ = 0.0f;
  float speed_factor_ = 1.0f;
  float follow_distance_m_ = 9.0f;
  glm::vec3 follow_target_{0.0f};
  float plan_height_m_ = 60.0f;  ///< of the plan that the picture shows
  std::optional<Flight> flight_;
};

}  // namespace parvis::viewer
