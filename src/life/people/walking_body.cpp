#include "life/people/walking_body.h"

#include <algorithm>
#include <cmath>

namespace parvis::people {
namespace {

constexpr float min_walking_m_s = 0.18f;  // slower bodies stand and shift their feet
constexpr float smoothing_s = 0.25f;      // of the speed
constexpr float change_s = 0.45f;         // from standing to walking and back
constexpr float quiet_step_s = 0.42f;     // of a foot that is put in its place while the body stands
constexpr float out_of_place_m = 0.09f, out_of_place_rad = 0.55f;
constexpr double flat_phase = 0.3;  // a foot that stands flat

float in_cycle(double phase) { return float(phase - std::floor(phase)); }
float short_turn(float angle) { return std::remainder(angle, 2.0f * pi); }

}  // namespace

WalkingBody::WalkingBody(const BodyField& body, const Lead& lead, float number)
    : body_(&body), number_(number) {
  now_.lead = lead;
  now_.time_s = double(number) * 7.3;
  for (const int side : {0, 1}) {
    Foot& foot = now_.feet[std::size_t(side)];
    foot.stands = foot.next = in_world(standing_place(body, side), lead, [&](glm::vec3 p) { return p.z; });
    foot.phase = flat_phase;
  }
  before_ = now_;
}

Footprint WalkingBody::in_world(const Footprint& print, const Lead& lead, const GroundHeight& ground) const {
  const float c = std::cos(lead.heading), s = std::sin(lead.heading);
  const glm::vec3 p = print.place;
  glm::vec3 place = lead.place + glm::vec3(c * p.x - s * p.y, s * p.x + c * p.y, 0.0f);
  // A step is no higher than this: what the ground has beside it, a wall or a pit, is no place for a foot.
  constexpr float max_step_m = 0.22f;
  const float height = ground(place);
  if (std::abs(height - lead.place.z) < max_step_m) place.z = height;
  return {place, print.yaw + lead.heading};
}

void WalkingBody::walk(float way_m, float step_s, const Stride& stride, const GroundHeight& ground) {
  State& n = now_;
  if (!n.walks) {  // the foot that is farther behind leaves first
    const glm::vec2 ahead(std::cos(n.lead.heading), std::sin(n.lead.heading));
    const auto along = [&](int side) {
      return glm::dot(glm::vec2(n.feet[std::size_t(side)].stands.place - n.lead.place), ahead);
    };
    const int first = in_cycle(n.feet[0].phase) > stride.duty   ? 0
                      : in_cycle(n.feet[1].phase) > stride.duty ? 1
                      : along(0) <= along(1)                    ? 0
                                                                : 1;
    const double leaves =
        std::max(double(in_cycle(n.feet[std::size_t(first)].phase)), double(stride.duty) - 0.04);
    n.feet[std::size_t(first)].phase = leaves;
    n.feet[std::size_t(1 - first)].phase = leaves - 0.5;
    n.walks = true;
  }
  const double advance = double(way_m / stride.length_m);
  for (const int side : {0, 1}) {
    Foot& foot = n.feet[std::size_t(side)];
    const double cycle = std::floor(foot.phase);
    foot.phase += advance;
    if (std::floor(foot.phase) > cycle) foot.stands = foot.next;  // set down
    const float phase = in_cycle(foot.phase);
    if (phase <= stride.duty) {
      if (phase < 0.5f * stride.duty) foot.next = foot.stands;
      continue;
    }
    const float s = (phase - stride.duty) / (1.0f - stride.duty);
    if (s > 0.85f) continue;  // its place is chosen
    // Where the body will be when the foot is set down, and half of the stance ahead of it.
    const float sign = side == 0 ? 1.0f : -1.0f;
    const Footprint print{
        {stride.length_m * (1.0f - phase + 0.5f * stride.duty) - stance_behind_m(body_->shape(), stride),
         sign * 0.62f * body_->shape().hip_y, 0.0f},
        sign * glm::radians(6.0f)};
    foot.next = in_world(print, n.lead, ground);
  }
  n.carriage_phase = n.feet[0].phase;
  n.walking = std::min(1.0f, n.walking + step_s / change_s);
}

void WalkingBody::stand(float step_s, const Stride& stride, const GroundHeight& ground) {
  State& n = now_;
  n.walks = false;
  n.walking = std::max(0.0f, n.walking - step_s / change_s);
  const float swing_per_s = (1.0f - stride.duty) / quiet_step_s;
  bool is_lifted = false;
  for (Foot& foot : n.feet) is_lifted = is_lifted || in_cycle(foot.phase) > stride.duty;
  for (const int side : {0, 1}) {
    Foot& foot = n.feet[std::size_t(side)];
    const Footprint place = in_world(standing_place(*body_, side), n.lead, ground);
    if (in_cycle(foot.phase) > stride.duty) {
      if (const float s = (in_cycle(foot.phase) - stride.duty) / (1.0f - stride.duty); s < 0.7f)
        foot.next = place;
      const double cycle = std::floor(foot.phase);
      foot.phase += double(step_s * swing_per_s);
      if (std::floor(foot.phase) > cycle) foot.stands = foot.next, foot.phase = cycle + 1.0;
      continue;
    }
    // Heel and toes come down.
    const double flat = std::floor(foot.phase) + flat_phase, most = double(step_s) * 0.9;
    foot.phase += std::clamp(flat - foot.phase, -most, most);
    const bool is_out =
        glm::distance(glm::vec2(place.place), glm::vec2(foot.stands.place)) > out_of_place_m ||
        std::abs(short_turn(place.yaw - foot.stands.yaw)) > out_of_place_rad;
    if (is_out && !is_lifted && std::abs(foot.phase - flat) < 0.02) {
      foot.phase = std::floor(foot.phase) + double(stride.duty) + 1e-3;
      foot.next = place, is_lifted = true;
    }
  }
}

void WalkingBody::step(const Lead& lead, float step_s, const GroundHeight& ground) {
  before_ = now_;
  now_.lead = lead, now_.time_s += double(step_s);
  const float way_m = glm::distance(glm::vec2(lead.place), glm::vec2(before_.lead.place));
  now_.speed += (way_m / step_s - now_.speed) * std::min(1.0f, step_s / smoothing_s);
  const Stride stride = stride_of(body_->shape(), std::max(now_.speed, 0.35f));
  if (now_.speed > min_walking_m_s)
    walk(way_m, step_s, stride, ground);
  else
    stand(step_s, stride, ground);
}

Lead WalkingBody::lead_at(float part) const {
  return {glm::mix(before_.lead.place, now_.lead.place, part),
          std::lerp(before_.lead.heading, now_.lead.heading, part)};
}

double WalkingBody::carriage_at(float part) const {
  const double advance = now_.carriage_phase - before_.carriage_phase;
  return before_.carriage_phase + double(part) * (std::abs(advance) < 0.5 ? advance : 0.0);
}

std::optional<float> WalkingBody::cycle_at(float part) const {
  if (std::lerp(before_.walking, now_.walking, part) < 0.5f) return std::nullopt;
  return in_cycle(carriage_at(part));
}

Posture WalkingBody::posture_at(float part) const {
  const Lead lead = lead_at(part);
  const Stride stride =
      stride_of(body_->shape(), std::max(std::lerp(before_.speed, now_.speed, part), 0.35f));
  const float c = std::cos(lead.heading), s = std::sin(lead.heading);
  const auto in_person = [&](const Footprint& print) {
    const glm::vec3 d = print.place - lead.place;
    return Footprint{{c * d.x + s * d.y, c * d.y - s * d.x, d.z}, short_turn(print.yaw - lead.heading)};
  };
  const auto mixed = [&](const Footprint& a, const Footprint& b) {
    return Footprint{glm::mix(a.place, b.place, part), a.yaw + part * short_turn(b.yaw - a.yaw)};
  };
  Feet feet;
  for (const std::size_t side : {0u, 1u}) {
    const Foot &from = before_.feet[side], &to = now_.feet[side];
    double phase = to.phase;
    const bool is_set_down = std::floor(to.phase) > std::floor(from.phase);
    if (std::abs(to.phase - from.phase) < 0.4) phase = from.phase + double(part) * (to.phase - from.phase);
    FootInCycle& foot = feet[side];
    foot.phase = in_cycle(phase);
    if (is_set_down && std::floor(phase) < std::floor(to.phase)) {  // still in the air
      foot.stands = in_person(from.stands), foot.next = in_person(to.stands);
    } else {
      foot.stands = in_person(to.stands),
      foot.next = in_person(is_set_down ? to.next : mixed(from.next, to.next));
    }
  }
  const float walking = std::lerp(before_.walking, now_.walking, part);
  Posture posture = carriage(*body_, stride, in_cycle(carriage_at(part)));
  if (walking < 1.0f) {
    const Posture spot =
        on_the_spot(*body_, activity, float(std::lerp(before_.time_s, now_.time_s, double(part))), number_);
    posture = between(spot, posture, walking * walking * (3.0f - 2.0f * walking));
  }
  put_down(*body_, stride, feet, posture);
  return posture;
}

}  // namespace parvis::people
