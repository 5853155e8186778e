#include "life/people/body_field.h"

#include <algorithm>
#include <cmath>

namespace parvis::people {
namespace {

float rise(float from, float to, float x) {
  const float t = glm::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

/// The heaviest four of a list of weights, summing to 1.
class Weights {
 public:
  void add(int bone, float weight) {
    if (weight > 1e-3f) list_.push_back({weight, bone});
  }
  BoundVertex take() {
    std::ranges::sort(list_, std::greater());
    list_.resize(std::min<std::size_t>(list_.size(), 4));
    BoundVertex result;
    result.weights = glm::vec4(0.0f);
    float sum = 0.0f;
    for (const auto& [weight, bone] : list_) sum += weight;
    for (std::size_t i = 0; i < list_.size(); ++i) {
      result.bones[int(i)] = std::uint32_t(list_[i].second);
      result.weights[int(i)] = list_[i].first / sum;
    }
    return result;
  }

 private:
  std::vector<std::pair<float, int>> list_;
};

void add_trunk(const BodyField& body, glm::vec3 p, float part, Weights& weights) {
  const Skeleton& k = body.skeleton();
  const float h = body.shape().stature;
  const float above_pelvis = rise(k.joint[spine].z - 0.05f * h, k.joint[spine].z + 0.05f * h, p.z),
              above_spine = rise(k.joint[chest].z - 0.05f * h, k.joint[chest].z + 0.05f * h, p.z),
              above_chest = rise(k.joint[neck].z - 0.01f * h, k.joint[neck].z + 0.05f * h, p.z);
  weights.add(pelvis, part * (1.0f - above_pelvis));
  weights.add(spine, part * above_pelvis * (1.0f - above_spine));
  weights.add(chest, part * above_spine * (1.0f - above_chest));
  weights.add(neck, part * above_chest);
}

void add_legs(const BodyField& body, glm::vec3 p, float part, float middle_m, Weights& weights) {
  const BodyShape& s = body.shape();
  const float h = s.stature, is_left = rise(-middle_m, middle_m, p.y);
  const float below_knee = 1.0f - rise(s.knee_z - 0.035f * h, s.knee_z + 0.035f * h, p.z);
  for (const bool left : {true, false}) {
    const float side = part * (left ? is_left : 1.0f - is_left);
    weights.add(left ? left_thigh : right_thigh, side * (1.0f - below_knee));
    weights.add(left ? left_shin : right_shin, side * below_knee);
  }
}

}  // namespace

BodyField::BodyField(const BodyShape& shape) : shape_(shape), skeleton_(skeleton_of(shape)) {
  const BodyShape& s = shape_;
  const float h = s.stature, d = s.shoulder_z - s.hip_z;  // of the trunk
  const auto at = [&](float part) { return s.hip_z + part * d; };
  stations_ = {
      {at(-0.16f), 0.70f * s.hips_half, 0.60f * s.hips_depth, 0.75f * s.hips_depth},
      {at(0.02f), s.hips_half, 0.90f * s.hips_depth, 1.22f * s.hips_depth},
      {at(0.14f), 0.97f * s.hips_half, 0.95f * s.hips_depth + 0.6f * s.belly, 1.12f * s.hips_depth},
      {at(0.30f), 0.5f * (s.hips_half + s.waist_half), s.waist_depth + s.belly, 0.93f * s.waist_depth},
      {at(0.42f), s.waist_half, s.waist_depth + 0.8f * s.belly, 0.92f * s.waist_depth},
      {at(0.60f), 0.5f * (s.waist_half + s.chest_half),
       0.5f * (s.waist_depth + s.chest_depth) + 0.3f * s.belly, 0.5f * (s.waist_depth + s.chest_depth)},
      {at(0.76f), s.chest_half, s.chest_depth, 1.06f * s.chest_depth},
      {at(0.88f), 0.97f * s.chest_half, 0.86f * s.chest_depth, 1.02f * s.chest_depth},
      {at(0.95f), 0.80f * s.chest_half, 0.62f * s.chest_depth, 0.88f * s.chest_depth},
      {at(1.02f), 0.48f * s.chest_half, 0.42f * s.chest_depth, 0.66f * s.chest_depth},
      {at(1.13f), 0.034f * h, 0.024f * h, 0.040f * h}};
}

TrunkStation BodyField::station(float z) const {
  if (z <= stations_.front().z) return stations_.front();
  for (std::size_t i = 1; i < stations_.size(); ++i) {
    const TrunkStation &a = stations_[i - 1], &b = stations_[i];
    if (z > b.z) continue;
    // Cubic through the stations with the slopes of their neighbours.
    const TrunkStation &before = stations_[i > 1 ? i - 2 : 0],
                       &after = stations_[std::min(i + 1, stations_.size() - 1)];
    const float width = b.z - a.z, t = (z - a.z) / width;
    const auto cubic = [&](float TrunkStation::*of) {
      const float from = (b.*of - before.*of) / std::max(b.z - before.z, 1e-4f) * width,
                  to = (after.*of - a.*of) / std::max(after.z - a.z, 1e-4f) * width;
      const float t2 = t * t, t3 = t2 * t;
      return (2 * t3 - 3 * t2 + 1) * a.*of + (t3 - 2 * t2 + t) * from + (3 * t2 - 2 * t3) * b.*of +
             (t3 - t2) * to;
    };
    return {z, cubic(&TrunkStation::half), cubic(&TrunkStation::front), cubic(&TrunkStation::back)};
  }
  return stations_.back();
}

float BodyField::trunk(glm::vec3 p, float offset_m) const {
  const float h = shape_.stature;
  const TrunkStation s = station(p.z);
  const float middle_x = -0.006f * h, x = p.x - middle_x;
  const float half = s.half + offset_m, depth = (x > 0.0f ? s.front : s.back) + offset_m;
  const float y2 = (p.y / half) * (p.y / half), x2 = (x / depth) * (x / depth);
  const float q =
      std::pow(std::pow(y2, 1.15f) + std::pow(x2, 1.15f), 1.0f / 2.3f);  // squarer than an ellipse
  float d = q > 1e-3f ? glm::length(glm::vec2(x, p.y)) * (1.0f - 1.0f / q) : -std::min(half, depth);
  d = smooth_max(d, std::max(stations_.front().z - p.z, p.z - stations_.back().z), 0.02f * h);
  if (shape_.bust > 0.0f) {
    const float z = std::lerp(shape_.hip_z, shape_.shoulder_z, 0.735f);
    const glm::vec3 q2(p.x, std::abs(p.y), p.z);
    const glm::vec3 middle(0.62f * shape_.chest_depth, 0.045f * h, z);
    d = smooth_min(d, glm::distance(q2, middle) - shape_.bust - 0.014f * h - offset_m, 0.05f * h);
  }
  // Shoulders: from the neck to the joints, and the deltoid's round.
  const glm::vec3 left(p.x, std::abs(p.y), p.z);
  const glm::vec3 shoulder = skeleton_.joint[left_upper_arm];
  d = smooth_min(d,
                 round_cone(left, skeleton_.joint[neck] + glm::vec3(0.0f, 0.020f * h, -0.006f * h),
                            shoulder + glm::vec3(0, -0.012f * h, 0.004f * h), 0.022f * h + offset_m,
                            0.026f * h * shape_.thickness + offset_m),
                 0.045f * h);
  return d;
}

float BodyField::along_arm(glm::vec3 p, float side) const {
  return glm::dot(p - skeleton_.joint[side > 0.0f ? left_upper_arm : right_upper_arm],
                  Skeleton::arm_direction(side));
}

float BodyField::arm(glm::vec3 p, float side, float offset_m) const {
  const float h = shape_.stature, k = shape_.thickness * (1.0f - 0.04f * shape_.childhood);
  const std::size_t first = side > 0.0f ? left_upper_arm : right_upper_arm;
  const glm::vec3 shoulder = skeleton_.joint[first], elbow = skeleton_.joint[first + 1],
                  wrist = skeleton_.joint[first + 2];
  const float soft = shape_.bust > 0.0f ? 0.90f : 1.0f;
  const float o = offset_m;
  float d = round_cone(p, shoulder + glm::vec3(0, 0, -0.004f * h), glm::mix(shoulder, elbow, 0.45f),
                       0.0295f * h * k + o, 0.028f * h * k * soft + o);
  d = smooth_min(d,
                 round_cone(p, glm::mix(shoulder, elbow, 0.4f), elbow, 0.0275f * h * k * soft + o,
                            0.0225f * h * k * soft + o),
                 0.02f * h);
  const glm::vec3 swell = glm::mix(elbow, wrist, 0.28f);
  d = smooth_min(d, round_cone(p, elbow, swell, 0.0235f * h * k * soft + o, 0.0245f * h * k * soft + o),
                 0.02f * h);
  d = smooth_min(d, round_cone(p, swell, wrist, 0.0245f * h * k * soft + o, 0.0155f * h * soft + o),
                 0.02f * h);
  return d;
}

float BodyField::leg(glm::vec3 p, float side, float offset_m) const {
  const float h = shape_.stature, k = shape_.thickness, o = offset_m;
  const std::size_t first = side > 0.0f ? left_thigh : right_thigh;
  const glm::vec3 hip = skeleton_.joint[first], knee = skeleton_.joint[first + 1],
                  ankle = skeleton_.joint[first + 2];
  float d = round_cone(p, hip + glm::vec3(0, 0.004f * h * side, -0.015f * h), knee, 0.053f * h * k + o,
                       0.0335f * h * k + o);
  const glm::vec3 calf = glm::mix(knee, ankle, 0.30f) + glm::vec3(-0.012f * h, 0.002f * h * side, 0.0f);
  d = smooth_min(d, round_cone(p, knee, calf, 0.031f * h * k + o, 0.0315f * h * k + o), 0.03f * h);
  d = smooth_min(d, round_cone(p, calf, ankle, 0.0315f * h * k + o, 0.021f * h + o), 0.03f * h);
  return d;
}

BoundVertex bound(const BodyField& body, glm::vec3 p, Moves moves) {
  const BodyShape& s = body.shape();
  const Skeleton& k = body.skeleton();
  const float h = s.stature;
  Weights weights;
  switch (moves) {
    case Moves::top: {
      const float side = p.y > 0.0f ? 1.0f : -1.0f;
      const std::size_t first = side > 0.0f ? left_upper_arm : right_upper_arm;
      const float to_trunk = std::max(0.0f, body.trunk(p, 0.008f)),
                  to_arm = std::max(0.0f, body.arm(p, side, 0.012f)), even = 0.012f;
      const float of_arm = rise(0.25f, 0.75f, (to_trunk + even) / (to_trunk + to_arm + 2.0f * even));
      const float along = body.along_arm(p, side);
      const float forearm = rise(s.upper_arm - 0.03f * h, s.upper_arm + 0.03f * h, along),
                  hand =
                      rise(s.upper_arm + s.forearm - 0.01f * h, s.upper_arm + s.forearm + 0.012f * h, along);
      weights.add(int(first), of_arm * (1.0f - forearm));
      weights.add(int(first) + 1, of_arm * forearm * (1.0f - hand));
      weights.add(int(first) + 2, of_arm * forearm * hand);
      // The hem of a long top follows the thighs a little.
      const float hanging =
          (1.0f - of_arm) * 0.5f * (1.0f - rise(s.hip_z - 0.03f * h, s.hip_z + 0.06f * h, p.z));
      add_legs(body, p, hanging, 0.06f * h, weights);
      add_trunk(body, p, 1.0f - of_arm - hanging, weights);
      break;
    }
    case Moves::bottom: {
      const float of_pelvis = rise(s.hip_z - 0.045f * h, s.hip_z + 0.045f * h, p.z);
      add_trunk(body, p, of_pelvis, weights);
      add_legs(body, p, 1.0f - of_pelvis, 0.012f * h, weights);
      break;
    }
    case Moves::skirt: {
      const float of_pelvis = std::max(0.25f, rise(s.hip_z - 0.10f * h, s.hip_z + 0.05f * h, p.z));
      add_trunk(body, p, of_pelvis, weights);
      add_legs(body, p, 1.0f - of_pelvis, 0.11f * h, weights);
      break;
    }
    case Moves::head_and_neck: {
      const float of_head = rise(s.chin_z - 0.30f * s.head, s.chin_z + 0.20f * s.head, p.z);
      const float of_neck =
          (1.0f - of_head) * rise(k.joint[neck].z - 0.02f * h, k.joint[neck].z + 0.02f * h, p.z);
      weights.add(head, of_head), weights.add(neck, of_neck), weights.add(chest, 1.0f - of_head - of_neck);
      break;
    }
    case Moves::hand_left:
    case Moves::hand_right: {
      const bool left = moves == Moves::hand_left;
      const std::size_t hand = left ? left_hand : right_hand;
      const glm::vec3 along = Skeleton::arm_direction(left ? 1.0f : -1.0f);
      const float at = glm::dot(p - k.joint[hand], along);
      const float fingers = rise(0.44f * s.hand, 0.56f * s.hand, at),
                  arm = 1.0f - rise(-0.02f * h, 0.006f * h, at);
      weights.add(int(hand), (1.0f - fingers) * (1.0f - arm));
      weights.add(int(hand) + 1, fingers), weights.add(int(hand) - 1, arm);
      break;
    }
    case Moves::shoes: {
      const std::size_t foot = p.y > 0.0f ? left_foot : right_foot;
      const float toes = rise(k.ball_x - 0.02f * h, k.ball_x + 0.02f * h, p.x),
                  shin = rise(s.ankle_z + 0.005f * h, s.ankle_z + 0.035f * h, p.z);
      weights.add(int(foot), (1.0f - toes) * (1.0f - shin));
      weights.add(int(foot) + 1, toes * (1.0f - shin)), weights.add(int(foot) - 1, shin);
      break;
    }
  }
  return weights.take();
}

}  // namespace parvis::people
