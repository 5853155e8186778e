#include "viewer/navigation.h"

#include <algorithm>
#include <cmath>

namespace parvis::viewer {
namespace {

constexpr float walk_speed = 1.6f;  // m/s, a brisk pedestrian
constexpr float fly_speed = 12.0f;  // m/s
constexpr float hurry_factor = 5.0f;
constexpr float highest_pitch = 1.5f;    // radians, short of the zenith, where heading loses its meaning
constexpr float follow_height_m = 0.9f;  // where the eye rests on a car
constexpr float lowest_eye_m = 0.4f;

}  // namespace

Navigation::Navigation(const Camera& start) : lens_(start), position_(0.0f) { go_to(start); }

void Navigation::go_to(const Camera& camera) {
  lens_ = camera;
  position_ = camera.position_in_world();
  if (mode_ == Mode::follow) mode_ = Mode::fly;
  const glm::vec3 forward = camera.forward_in_world();
  heading_ = std::atan2(forward.y, forward.x);
  pitch_ = std::asin(std::clamp(forward.z, -1.0f, 1.0f));
}

void Navigation::set_mode(Mode mode) {
  mode_ = mode;
  speed_factor_ = 1.0f;
}

glm::vec3 Navigation::looks() const {
  return {std::cos(heading_) * std::cos(pitch_), std::sin(heading_) * std::cos(pitch_), std::sin(pitch_)};
}

void Navigation::step(const Controls& controls, float seconds, const glm::mat4& target) {
  heading_ += controls.turn.x;
  pitch_ = std::clamp(pitch_ + controls.turn.y, -highest_pitch, highest_pitch);

  if (mode_ == Mode::follow) {
    follow_distance_m_ = std::clamp(follow_distance_m_ * std::pow(0.9f, controls.zoom), 2.5f, 200.0f);
    follow_target_ = glm::vec3(target[3]) + glm::vec3(0.0f, 0.0f, follow_height_m);
    position_ = follow_target_ - follow_distance_m_ * looks();
    position_.z = std::max(position_.z, float(target[3].z) + lowest_eye_m);
    return;
  }

  speed_factor_ = std::clamp(speed_factor_ * std::pow(1.2f, controls.zoom), 0.05f, 50.0f);
  const float speed = (mode_ == Mode::walk ? walk_speed : fly_speed) * speed_factor_ *
                      (controls.hurries ? hurry_factor : 1.0f);
  const glm::vec3 ahead =
      mode_ == Mode::walk ? glm::vec3(std::cos(heading_), std::sin(heading_), 0.0f) : looks();
  const glm::vec3 left(-std::sin(heading_), std::cos(heading_), 0.0f);
  const float climb = mode_ == Mode::walk ? 0.0f : controls.move.z;
  const glm::vec3 direction =
      controls.move.x * ahead + controls.move.y * left + climb * glm::vec3(0.0f, 0.0f, 1.0f);
  const float length = glm::length(direction);
  if (length > 0.0f) position_ += direction * (speed * seconds / std::max(length, 1.0f));
}

Camera Navigation::camera() const {
  Camera camera = lens_;
  camera.world_from_camera = look_at(position_, mode_ == Mode::follow ? follow_target_ : position_ + looks());
  return camera;
}

}  // namespace parvis::viewer
