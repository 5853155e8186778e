#include "viewer/navigation.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace parvis::viewer {
namespace {

constexpr float walk_speed = 1.6f;  // m/s, a brisk pedestrian
constexpr float fly_speed = 12.0f;  // m/s
constexpr float hurry_factor = 5.0f;
constexpr float highest_pitch = 1.5f;    // radians, short of the zenith, where heading loses its meaning
constexpr float follow_height_m = 0.9f;  // where the eye rests on a car
constexpr float lowest_eye_m = 0.4f;
constexpr float plan_eye_m = 300.0f;      // of a plan's eye above what it shows
constexpr float longest_stride_s = 0.1f;  // on foot: a longer step would lead through a wall
constexpr float smallest_plan_m = 2.0f, largest_plan_m = 20'000.0f;

}  // namespace

Navigation::Navigation(const Camera& start) : lens_(start), position_(0.0f) { go_to(start); }

void Navigation::go_to(const Camera& camera) {
  lens_ = camera;
  position_ = camera.position_in_world();
  flight_.reset();
  if (camera.parallel) {
    mode_ = Mode::plan;
    plan_height_m_ = camera.parallel->height_m;
    position_.z = 0.0f;
    lens_.parallel.reset();
    lens_.near_m = Camera().near_m, lens_.far_m = Camera().far_m;
    return;
  }
  if (mode_ == Mode::follow || mode_ == Mode::plan) mode_ = Mode::fly;
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

void Navigation::fly_to(const Camera& camera, float seconds, std::optional<Mode> arrives_in) {
  if (mode_ == Mode::plan) {  // from above the middle of what it shows
    const float height_m = plan_height_m_ / (2.0f * std::tan(0.5f * lens_.vertical_fov));
    position_.z += height_m;
    heading_ = glm::half_pi<float>(), pitch_ = -highest_pitch;
    mode_ = Mode::fly;
  }
  glm::vec3 to = camera.position_in_world(), forward = camera.forward_in_world();
  float heading_to = std::atan2(forward.y, forward.x);
  if (camera.parallel) {
    to.z = camera.parallel->height_m / (2.0f * std::tan(0.5f * lens_.vertical_fov));
    heading_to = glm::half_pi<float>();
  }
  const float turn = std::remainder(heading_to - heading_, glm::two_pi<float>());
  flight_ = Flight{position_,
                   to,
                   heading_,
                   heading_ + turn,
                   pitch_,
                   std::clamp(std::asin(std::clamp(forward.z, -1.0f, 1.0f)), -highest_pitch, highest_pitch),
                   lens_.vertical_fov,
                   camera,
                   0.0f,
                   seconds,
                   arrives_in};
}

void Navigation::step_flight(float seconds) {
  Flight& flight = *flight_;
  flight.passed_s += seconds;
  if (flight.passed_s >= flight.seconds) {
    const Mode mode = flight.arrives_in.value_or(mode_);
    go_to(Camera(flight.camera));
    if (mode_ != Mode::plan) mode_ = mode;
    return;
  }
  const float along = glm::smoothstep(0.0f, 1.0f, flight.passed_s / flight.seconds);
  position_ = glm::mix(flight.from, flight.to, along);
  heading_ = glm::mix(flight.heading_from, flight.heading_to, along);
  pitch_ = glm::mix(flight.pitch_from, flight.pitch_to, along);
  if (!flight.camera.parallel)
    lens_.vertical_fov = glm::mix(flight.fov_from, flight.camera.vertical_fov, along);
}

void Navigation::step_plan(const Controls& controls, float seconds) {
  constexpr float pans_per_s = 0.7f;  // heights of the picture
  glm::vec2 pan = controls.pan;
  pan +=
      pans_per_s * seconds * (controls.hurries ? 3.0f : 1.0f) * glm::vec2(controls.move.y, -controls.move.x);
  position_ -= plan_height_m_ * glm::vec3(pan, 0.0f);
  const float before = plan_height_m_;
  plan_height_m_ = std::clamp(before * std::pow(0.85f, controls.zoom), smallest_plan_m, largest_plan_m);
  position_ += (before - plan_height_m_) * glm::vec3(controls.zoom_at, 0.0f);
}

void Navigation::step(const Controls& controls, float seconds, const glm::mat4& target) {
  if (flight_) {
    const bool moves = controls.move != glm::vec3(0.0f) || controls.turn != glm::vec2(0.0f);
    if (!moves) return step_flight(seconds);
    flight_.reset();
  }
  if (mode_ == Mode::plan) return step_plan(controls, seconds);
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
  if (length == 0.0f) return;
  const int steps = std::max(1, int(std::ceil(seconds / longest_stride_s)));
  const glm::vec3 step = direction * (speed * seconds / (std::max(length, 1.0f) * float(steps)));
  for (int i = 0; i < steps; ++i) {
    const glm::vec3 to = position_ + step;
    if (mode_ != Mode::walk || !on_foot)
      position_ = to;
    else if (const std::optional<glm::vec3> reached = on_foot(position_, to))
      position_ = *reached;
  }
}

Camera Navigation::camera() const {
  Camera camera = lens_;
  if (mode_ == Mode::plan) {
    const glm::vec3 eye = position_ + glm::vec3(0.0f, 0.0f, plan_eye_m);
    camera.world_from_camera = look_at(eye, position_, {0.0f, 1.0f, 0.0f});
    camera.parallel = ParallelView{plan_height_m_, plan_eye_m};
    camera.near_m = 1.0f, camera.far_m = 2.0f * plan_eye_m;
    return camera;
  }
  camera.world_from_camera = look_at(position_, mode_ == Mode::follow ? follow_target_ : position_ + looks());
  return camera;
}

}  // namespace parvis::viewer
