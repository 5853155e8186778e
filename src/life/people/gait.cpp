#include "life/people/gait.h"

#include <algorithm>
#include <cmath>

namespace parvis::people {
namespace {

using glm::vec3;

constexpr float two_pi = 2.0f * pi;
constexpr float ordinary_froude_speed = 0.45f;  // speed over the root of g times leg: 1.34 m/s of an adult
constexpr int curve_points = 20;

// At 0, 5, ... 95 % of the cycle, degrees.
constexpr std::array<float, curve_points> knee_curve{5.5f,  12.7f, 18.9f, 19.3f, 16.9f, 13.9f, 10.8f,
                                                     8.3f,  6.8f,  7.5f,  11.6f, 20.3f, 34.1f, 49.8f,
                                                     59.4f, 59.2f, 50.8f, 36.2f, 19.0f, 5.8f};
constexpr std::array<float, curve_points> hip_curve{31.0f, 30.0f, 27.0f, 23.0f,  18.0f, 12.5f, 7.0f,
                                                    2.0f,  -3.0f, -7.0f, -10.0f, -9.5f, -4.0f, 5.0f,
                                                    15.0f, 23.5f, 30.0f, 33.5f,  34.0f, 32.5f};
constexpr std::array<float, curve_points> ankle_curve{0.0f,  -5.0f, -5.0f, -1.0f, 3.0f, 5.0f,   7.0f,
                                                      8.5f,  9.5f,  10.0f, 8.0f,  0.0f, -12.0f, -17.0f,
                                                      -9.0f, -3.0f, 0.0f,  1.5f,  2.0f, 1.5f};

float at_phase(const std::array<float, curve_points>& curve, float phase) {
  const float x = (phase - std::floor(phase)) * float(curve_points);
  const int i = int(x) % curve_points;
  const float t = x - std::floor(x);
  const auto value = [&](int k) { return curve[std::size_t((i + k + curve_points) % curve_points)]; };
  return value(0) + 0.5f * t *
                        (value(1) - value(-1) +
                         t * (2 * value(-1) - 5 * value(0) + 4 * value(1) - value(2) +
                              t * (3 * (value(0) - value(1)) + value(2) - value(-1))));
}

float ease(float from, float to, float x) {
  const float t = glm::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

constexpr float flat_from = 0.09f;      // phase at which the sole is on the ground
constexpr float heel_off_part = 0.54f;  // of the duty, after which the heel rises
constexpr float strike_deg = 20.0f, push_off_deg = 64.0f;

/// Where a foot is: its ankle, its pitch (toes up), where it points, and how far the toes are bent up.
struct FootPose {
  vec3 ankle;
  float pitch = 0.0f, yaw = 0.0f, toes_up = 0.0f;
};

/// A foot on the ground that is pitched about heel or ball.
FootPose pitched(const BodyField& body, const Footprint& print, float pitch) {
  const Skeleton& k = body.skeleton();
  const float ankle_x = k.joint[left_foot].x, z = body.shape().ankle_z;
  const float pivot = pitch > 0.0f ? k.heel_x : k.ball_x - ankle_x;
  const float c = std::cos(pitch), s = std::sin(pitch);
  const float along = pivot + -pivot * c - z * s, up = -pivot * s + z * c;
  const vec3 forward(std::cos(print.yaw), std::sin(print.yaw), 0.0f);
  return {print.place + along * forward + vec3(0, 0, up), pitch, print.yaw, std::max(0.0f, -pitch)};
}

float stance_pitch(float phase, const Stride& stride) {
  const float heel_off = heel_off_part * stride.duty;
  if (phase < flat_from) {
    const float t = 1.0f - phase / flat_from;
    return glm::radians(strike_deg) * stride.excursion * t * t;
  }
  if (phase < heel_off) return 0.0f;
  const float t = (phase - heel_off) / (stride.duty - heel_off);
  return -glm::radians(push_off_deg) * std::min(stride.excursion, 1.15f) * t * t * (0.45f + 0.55f * t);
}

FootPose foot_pose(const BodyField& body, const Stride& stride, const FootInCycle& foot) {
  if (foot.phase <= stride.duty) return pitched(body, foot.stands, stance_pitch(foot.phase, stride));
  const float s = (foot.phase - stride.duty) / (1.0f - stride.duty);
  const FootPose from = pitched(body, foot.stands, stance_pitch(stride.duty, stride)),
                 to = pitched(body, foot.next, stance_pitch(0.0f, stride));
  // It leaves while it already moves, and is set down at rest (a cubic with these slopes at its ends).
  const float q = std::min(s / 0.94f, 1.0f),
              t = q * q * (3.0f - 2.0f * q) + 0.4f * q * (1.0f - q) * (1.0f - q);
  FootPose pose;
  pose.ankle = glm::mix(from.ankle, to.ankle, t);
  const float lift = 0.030f * body.shape().stature * std::min(1.0f, stride.excursion);
  pose.ankle.z = std::lerp(from.ankle.z, to.ankle.z, ease(0.05f, 0.97f, s)) +
                 lift * std::sin(pi * std::pow(s, 0.65f));  // the ball leaves the ground before it gets on
  pose.pitch = std::lerp(from.pitch, to.pitch, ease(0.0f, 0.92f, s));
  pose.yaw = std::lerp(from.yaw, to.yaw, ease(0.0f, 1.0f, s));
  pose.toes_up = from.toes_up * (1.0f - ease(0.0f, 0.35f, s));
  return pose;
}

/// The distance from hip to ankle with the knee flexed.
float reach(const BodyField& body, float knee_deg) {
  const Skeleton& k = body.skeleton();
  const float a = glm::distance(k.joint[left_thigh], k.joint[left_shin]),
              b = glm::distance(k.joint[left_shin], k.joint[left_foot]);
  return std::sqrt(a * a + b * b + 2.0f * a * b * std::cos(glm::radians(knee_deg)));
}

glm::quat about(vec3 axis, float degrees) { return glm::angleAxis(glm::radians(degrees), axis); }
const vec3 x_axis(1, 0, 0), y_axis(0, 1, 0), z_axis(0, 0, 1);

/// Turns an arm: flexion forward, angle to the trunk, elbow; degrees.
void set_arm(const BodyField& body, Posture& posture, int side, float flexion, float away, float elbow,
             float inward = 0.0f) {
  const float sign = side == 0 ? 1.0f : -1.0f;
  const std::size_t arm = side == 0 ? left_upper_arm : right_upper_arm;
  const float thick = std::max(0.0f, body.shape().thickness - 1.0f);
  posture.turn[arm] = about(z_axis, -sign * inward) * about(y_axis, -flexion) *
                      about(x_axis, -sign * (bind_arm_deg - away - 28.0f * thick));
  const vec3 elbow_axis = about(x_axis, sign * bind_arm_deg) * y_axis;
  posture.turn[arm + 1] = glm::angleAxis(glm::radians(-elbow), elbow_axis);
}

/// Puts both feet down and the pelvis as high as the legs reach.
void settle_on(const BodyField& body, Posture& posture, const std::array<FootPose, 2>& feet,
               const std::array<float, 2>& length) {
  const Skeleton& k = body.skeleton();
  float height = 1e9f;
  const glm::quat turn = posture.turn[pelvis];
  for (const std::size_t side : {0u, 1u}) {
    const vec3 hip = turn * (k.joint[side == 0 ? left_thigh : right_thigh] - k.joint[pelvis]);
    const glm::vec2 away = glm::vec2(feet[side].ankle) - glm::vec2(posture.pelvis_position + hip);
    const float top = feet[side].ankle.z - hip.z +
                      std::sqrt(std::max(length[side] * length[side] - glm::dot(away, away), 0.01f));
    height = height > 1e8f ? top : smooth_min(height, top, 0.035f * body.shape().stature);
  }
  posture.pelvis_position.z = height;
  for (const int side : {0, 1}) {
    const FootPose& foot = feet[std::size_t(side)];
    place_foot(body, posture, side, foot.ankle, foot.pitch, foot.yaw, foot.toes_up);
  }
}

}  // namespace

LegAngles normal_angles(float phase) {
  return {at_phase(hip_curve, phase), at_phase(knee_curve, phase), at_phase(ankle_curve, phase)};
}

Stride stride_of(const BodyShape& shape, float speed_m_s) {
  const float leg = shape.leg(), relative = std::max(speed_m_s, 0.12f) / std::sqrt(9.81f * leg);
  Stride stride;
  stride.length_m = 2.0f * leg * 0.82f * std::pow(relative / ordinary_froude_speed, 0.42f);
  stride.duty = glm::clamp(0.62f - 0.10f * (relative - ordinary_froude_speed), 0.56f, 0.68f);
  stride.excursion = std::pow(relative / ordinary_froude_speed, 0.42f);
  return stride;
}

float stance_behind_m(const BodyShape& shape, const Stride& stride) {
  return 0.085f * shape.leg() * std::min(stride.excursion, 1.0f);
}

Feet straight_feet(const BodyField& body, const Stride& stride, float left_phase) {
  Feet feet;
  for (const int side : {0, 1}) {
    FootInCycle& foot = feet[std::size_t(side)];
    foot.phase = left_phase + 0.5f * float(side);
    foot.phase -= std::floor(foot.phase);
    const float sign = side == 0 ? 1.0f : -1.0f;
    const float x =
        stride.length_m * (0.5f * stride.duty - foot.phase) - stance_behind_m(body.shape(), stride);
    foot.stands = {{x, sign * 0.62f * body.shape().hip_y, 0.0f}, sign * glm::radians(6.0f)};
    foot.next = foot.stands;
    foot.next.place.x += stride.length_m;
  }
  return feet;
}

Posture carriage(const BodyField& body, const Stride& stride, float left_phase) {
  const float h = body.shape().stature, e = stride.excursion, p = left_phase;
  const float wave = std::cos(two_pi * p), shift = std::sin(two_pi * p);
  Posture posture;
  posture.pelvis_position = {body.skeleton().joint[pelvis].x, 0.010f * h * shift, 0.0f};
  posture.turn[pelvis] =
      about(z_axis, -4.0f * e * wave) * about(x_axis, 2.6f * e * shift) * about(y_axis, 3.0f);
  posture.turn[spine] =
      about(z_axis, 4.0f * e * wave) * about(x_axis, -2.2f * e * shift) * about(y_axis, 0.5f);
  posture.turn[chest] = about(z_axis, 4.5f * e * wave) * about(x_axis, -0.8f * e * shift);
  posture.turn[neck] = about(z_axis, -2.5f * e * wave) * about(y_axis, -1.0f);
  posture.turn[head] =
      about(z_axis, -2.0f * e * wave) * about(y_axis, -2.0f + 0.8f * std::cos(2.0f * two_pi * p));
  for (const int side : {0, 1}) {
    const float swing = std::cos(two_pi * (p + 0.5f * float(side) + 0.48f));  // with the other leg
    set_arm(body, posture, side, 3.0f + 19.0f * e * swing, 7.0f,
            16.0f + 5.0f * e + 11.0f * e * (swing + 0.4f), 3.0f);
    posture.turn[side == 0 ? left_hand : right_hand] = about(y_axis, -6.0f);
  }
  return posture;
}

void put_down(const BodyField& body, const Stride& stride, const Feet& feet, Posture& posture) {
  std::array<FootPose, 2> poses;
  std::array<float, 2> length{};
  for (const std::size_t side : {0u, 1u}) {
    poses[side] = foot_pose(body, stride, feet[side]);
    const float phase = feet[side].phase;
    // The knee of the leg that carries, as in normal gait; of the others what is needed.
    const float carries = phase < 0.5f ? 1.0f - ease(0.38f, 0.46f, phase) : ease(0.92f, 1.0f, phase);
    const float knee = at_phase(knee_curve, phase) * std::min(1.2f, stride.excursion);
    length[side] = reach(body, std::lerp(3.5f, knee, carries));
  }
  settle_on(body, posture, poses, length);
}

void hold_handle(const BodyField& body, Posture& posture) {
  for (const int side : {0, 1}) {
    set_arm(body, posture, side, 24.0f, 3.0f, 58.0f, 4.0f);
    posture.turn[side == 0 ? left_hand : right_hand] = about(y_axis, -4.0f);
  }
}

BicyclePlaces bicycle_for(const BodyField& body) {
  const Skeleton& k = body.skeleton();
  const float leg = glm::distance(k.joint[left_thigh], k.joint[left_shin]) +
                    glm::distance(k.joint[left_shin], k.joint[left_foot]);
  constexpr float seat_tube_rad = 1.27f, ankle_over_pedal = 0.10f, stretched = 0.93f;
  BicyclePlaces places;
  // Along the seat tube, until the leg at the lower pedal is nearly straight.
  const float reach_m = stretched * leg + ankle_over_pedal - places.crank_m;
  const float hip_over_saddle = 0.055f * body.shape().stature;
  const float length = reach_m - hip_over_saddle;
  places.saddle = places.cranks + length * vec3(-std::cos(seat_tube_rad), 0.0f, std::sin(seat_tube_rad));
  return places;
}

Posture on_bicycle(const BodyField& body, const BicyclePlaces& places, float turn) {
  const float h = body.shape().stature;
  Posture posture;
  posture.pelvis_position = places.saddle + vec3(0.0f, 0.0f, 0.055f * h);
  posture.turn[pelvis] = about(y_axis, 14.0f), posture.turn[spine] = about(y_axis, 9.0f);
  posture.turn[chest] = about(y_axis, 5.0f), posture.turn[neck] = about(y_axis, -9.0f);
  posture.turn[head] = about(y_axis, -14.0f);
  for (const int side : {0, 1}) {
    set_arm(body, posture, side, 72.0f, 10.0f, 16.0f, 2.0f);
    const float angle = turn + (side == 0 ? 0.0f : pi), sign = side == 0 ? 1.0f : -1.0f;
    const vec3 pedal = places.cranks + places.crank_m * vec3(std::cos(angle), 0.0f, -std::sin(angle));
    // The ball of the foot is on the pedal; the heel drops a little in front and rises behind.
    const float pitch = glm::radians(-8.0f + 10.0f * std::cos(angle));
    const vec3 ankle =
        pedal + vec3(-0.75f * body.skeleton().ball_x * std::cos(pitch), sign * 0.105f,
                     body.shape().ankle_z + 0.01f - 0.75f * body.skeleton().ball_x * std::sin(pitch));
    place_foot(body, posture, side, ankle, pitch, 0.0f, 0.0f);
  }
  return posture;
}

Posture walking(const BodyField& body, const Stride& stride, const Feet& feet) {
  Posture posture = carriage(body, stride, feet[0].phase);
  put_down(body, stride, feet, posture);
  return posture;
}

Footprint standing_place(const BodyField& body, int side) {
  const float sign = side == 0 ? 1.0f : -1.0f;
  return {{0.0f, sign * 1.05f * body.shape().hip_y, 0.0f}, sign * glm::radians(9.0f)};
}

float place_foot(const BodyField& body, Posture& posture, int side, vec3 ankle, float pitch, float yaw,
                 float toes_up) {
  const Skeleton& k = body.skeleton();
  const std::size_t first = side == 0 ? left_thigh : right_thigh;
  const vec3 thigh0 = k.joint[first + 1] - k.joint[first], shin0 = k.joint[first + 2] - k.joint[first + 1];
  const float a = glm::length(thigh0), b = glm::length(shin0);
  const glm::quat of_pelvis = posture.turn[pelvis];
  const vec3 hip = posture.pelvis_position + of_pelvis * (k.joint[first] - k.joint[pelvis]);
  const vec3 to = ankle - hip;
  const float wanted = glm::length(to),
              distance = glm::clamp(wanted, std::abs(a - b) + 1e-3f, 0.9998f * (a + b));
  const vec3 along = wanted > 1e-5f ? to / wanted : vec3(0, 0, -1);
  const vec3 ahead(std::cos(yaw), std::sin(yaw), 0.0f);
  vec3 pole = ahead - glm::dot(ahead, along) * along;
  pole = glm::length(pole) > 1e-3f ? glm::normalize(pole) : vec3(0, 0, 1);
  const float to_knee = (a * a - b * b + distance * distance) / (2.0f * distance),
              out = std::sqrt(std::max(a * a - to_knee * to_knee, 0.0f));
  const vec3 knee = hip + to_knee * along + out * pole, end = hip + distance * along;
  const vec3 lateral = glm::normalize(glm::cross(-along, pole));
  const auto turned = [&](vec3 bind, vec3 now) {
    const auto frame = [](vec3 down, vec3 left) {
      const vec3 d = glm::normalize(down), l = glm::normalize(left - glm::dot(left, d) * d);
      return glm::mat3(d, l, glm::cross(d, l));
    };
    return glm::normalize(glm::quat_cast(frame(now, lateral) * glm::transpose(frame(bind, y_axis))));
  };
  const glm::quat thigh = turned(thigh0, knee - hip), shin = turned(shin0, end - knee);
  const glm::quat foot = glm::angleAxis(yaw, z_axis) * glm::angleAxis(-pitch, y_axis);
  posture.turn[first] = glm::inverse(of_pelvis) * thigh;
  posture.turn[first + 1] = glm::inverse(thigh) * shin;
  posture.turn[first + 2] = glm::inverse(shin) * foot;
  posture.turn[first + 3] = glm::angleAxis(-toes_up, y_axis);
  return std::max(0.0f, wanted - distance);
}

Posture on_the_spot(const BodyField& body, Activity activity, float time_s, float number, float seat_m) {
  const BodyShape& s = body.shape();
  const float h = s.stature;
  const auto wave = [&](float period_s, float offset) {
    return std::sin(two_pi * (time_s / period_s + offset + 0.37f * number));
  };
  const float lean = 0.6f * wave(9.0f, 0.1f) + 0.4f * wave(5.3f, 0.4f),
              look = 0.6f * wave(11.0f, 0.2f) + 0.4f * wave(6.7f, 0.8f);
  Posture posture;
  const bool leans_left = std::sin(7.0f * number) > 0.0f;
  const float carries = leans_left ? 1.0f : -1.0f;
  posture.pelvis_position = {body.skeleton().joint[pelvis].x, (0.012f * carries + 0.004f * lean) * h, 0.0f};
  posture.turn[pelvis] = about(x_axis, 2.2f * carries) * about(y_axis, 1.0f) * about(z_axis, 2.0f * look);
  posture.turn[spine] = about(x_axis, -2.0f * carries) * about(y_axis, 1.0f + 0.4f * wave(4.1f, 0.0f));
  posture.turn[chest] = about(y_axis, 0.6f * wave(4.1f, 0.05f)) * about(z_axis, 3.0f * look);
  posture.turn[neck] = about(z_axis, 6.0f * look);
  posture.turn[head] = about(z_axis, 12.0f * look) * about(y_axis, 3.0f + 3.0f * wave(7.9f, 0.6f));
  for (const int side : {0, 1}) set_arm(body, posture, side, 2.0f + 1.5f * lean, 7.0f, 14.0f, 4.0f);
  if (activity == Activity::phone) {
    set_arm(body, posture, 1, 22.0f, 9.0f, 102.0f, 24.0f);
    posture.turn[right_hand] = about(y_axis, -8.0f);
    posture.turn[neck] = about(y_axis, 12.0f),
    posture.turn[head] = about(y_axis, 16.0f) * about(z_axis, -4.0f + 2.0f * look);
  } else if (activity == Activity::talk) {
    const float speaks = 0.5f + 0.5f * wave(3.1f, 0.0f);
    set_arm(body, posture, 1, 14.0f + 10.0f * speaks, 14.0f, 62.0f + 26.0f * speaks,
            12.0f * wave(1.7f, 0.3f));
    posture.turn[head] = about(z_axis, 8.0f * look) * about(y_axis, 2.0f + 3.0f * wave(1.9f, 0.2f));
  } else if (activity == Activity::wait) {
    set_arm(body, posture, 0, 16.0f, 12.0f, 88.0f, 48.0f);
    set_arm(body, posture, 1, 12.0f, 12.0f, 84.0f, 44.0f);
  }
  std::array<FootPose, 2> feet;
  if (activity == Activity::sit) {
    posture.pelvis_position = {0.0f, 0.0f, seat_m + 0.055f * h};
    posture.turn[pelvis] = about(y_axis, -6.0f), posture.turn[spine] = about(y_axis, 5.0f);
    for (const int side : {0, 1}) {
      const float sign = side == 0 ? 1.0f : -1.0f;
      set_arm(body, posture, side, 24.0f, 11.0f, 58.0f, 14.0f);
      const float ankle_x = s.thigh() - 0.02f * h + 0.02f * h * sign * carries;
      const float z = std::min(s.ankle_z, seat_m);
      place_foot(body, posture, side, {ankle_x, sign * 1.15f * s.hip_y, z}, 0.0f, sign * 0.12f, 0.0f);
    }
    return posture;
  }
  std::array<float, 2> length{};
  for (const std::size_t side : {0u, 1u}) {
    const float sign = side == 0 ? 1.0f : -1.0f;
    const bool is_carrying = sign == carries;
    const Footprint print{{is_carrying ? -0.01f * h : 0.025f * h, sign * 1.05f * s.hip_y, 0.0f},
                          sign * glm::radians(is_carrying ? 6.0f : 13.0f)};
    feet[side] = pitched(body, print, 0.0f);
    length[side] = reach(body, is_carrying ? 4.0f : 3.0f);
  }
  settle_on(body, posture, feet, length);
  return posture;
}

}  // namespace parvis::people
