#include "life/people/clothes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/colour.h"

namespace parvis::people {
namespace {

using glm::vec3;

constexpr float cloth_tile_m = 0.10f, cloth_tiles_round = 9.0f;  // of the texture of yarns
constexpr float hem_room_m = 0.04f;  // cloth goes on beyond its hem, where it is cut

float fade(float from, float to, float x) {
  const float t = glm::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

float rounded_box(vec3 p, vec3 half, float radius) {
  const vec3 q = glm::abs(p) - half + radius;
  return glm::length(glm::max(q, vec3(0.0f))) + std::min(std::max({q.x, q.y, q.z}), 0.0f) - radius;
}

/// Cloth of a shape: what all garments of one person ask for.
class Tailor {
 public:
  Tailor(const BodyField& body, const Outfit& outfit, float detail)
      : body_(body),
        s_(body.shape()),
        k_(body.skeleton()),
        outfit_(outfit),
        detail_(detail),
        h_(s_.stature) {}

  std::vector<Garment> dress() {
    add_top();
    if (outfit_.top == Top::jacket || outfit_.top == Top::coat) add_shirt();
    if (outfit_.top == Top::t_shirt) add_arms();
    add_bottom();
    add_hands();
    add_shoes();
    add_bag();
    return std::move(garments_);
  }

 private:
  using Shade = std::function<float(vec3 place, vec3 normal)>;

  float cloth_m() const {
    switch (outfit_.top) {
      case Top::t_shirt:
        return 0.009f;
      case Top::blouse:
        return 0.008f;
      case Top::pullover:
        return 0.014f;
      case Top::jacket:
        return 0.019f;
      case Top::coat:
        return 0.022f;
    }
    return 0.01f;
  }
  float hem_z() const {
    switch (outfit_.top) {
      case Top::t_shirt:
        return s_.hip_z - 0.004f * h_;
      case Top::blouse:
        return s_.hip_z + 0.06f * h_;  // tucked in
      case Top::pullover:
        return s_.hip_z + 0.008f * h_;
      case Top::jacket:
        return s_.hip_z - 0.022f * h_;
      case Top::coat:
        return s_.knee_z + 0.045f * h_;
    }
    return s_.hip_z;
  }
  bool wears_skirt() const { return outfit_.bottom == Bottom::skirt || outfit_.bottom == Bottom::dress; }

  /// Depth of folds at a place of a sleeve or a leg: rings that lie across it near a joint, and slack cloth.
  static float folds(float along, float around, float near_m, float depth_m) {
    const float at = std::exp(-(along / near_m) * (along / near_m));
    return depth_m * at *
           std::sin(2.0f * pi * along / 0.095f + 1.3f * std::sin(around) +
                    0.6f * std::sin(2.0f * around + 1.0f));
  }

  /// A tube around the trunk from `low` up that widens downward by `flare` metres.
  float hanging(vec3 p, float low, float offset, float flare, float pleats) const {
    const float top = s_.hip_z + 0.17f * h_,
                t = glm::clamp((top - p.z) / std::max(top - low, 0.01f), 0.0f, 1.0f);
    const TrunkStation hips = body_.station(s_.hip_z + 0.01f * h_),
                       above = body_.station(std::max(p.z, s_.hip_z + 0.01f * h_));
    const float part = p.z > s_.hip_z ? 1.0f : 0.0f;
    const float half = (part > 0.0f ? above.half : hips.half) + offset + flare * t;
    const float angle = std::atan2(p.y, p.x),
                fold = pleats * t * std::sin(11.0f * angle + 2.0f * std::sin(3.0f * angle));
    const float front = (part > 0.0f ? above.front : hips.front) + offset + flare * t + 0.012f * t,
                back = (part > 0.0f ? above.back : hips.back) + offset + 0.8f * flare * t;
    const float depth = p.x > 0.0f ? front : back;
    const float q = std::sqrt((p.y / half) * (p.y / half) + (p.x / depth) * (p.x / depth));
    const float d = q > 1e-3f ? glm::length(glm::vec2(p)) * (1.0f - 1.0f / q) : -half;
    return std::max(d - fold, std::max(low - hem_room_m - p.z, p.z - top));
  }

  float sleeve(vec3 p, float side, float cloth) const {
    const std::size_t first = side > 0.0f ? left_upper_arm : right_upper_arm;
    const vec3 elbow = k_.joint[first + 1], wrist = k_.joint[first + 2];
    const float along = body_.along_arm(p, side), whole = s_.upper_arm + s_.forearm;
    const bool is_short = outfit_.top == Top::t_shirt;
    float d = body_.arm(p, side, cloth + (is_short ? 0.006f : 0.002f));
    if (is_short) {
      const vec3 direction = Skeleton::arm_direction(side);
      d = smooth_min(d,
                     round_cone(p, k_.joint[first], k_.joint[first] + 0.6f * s_.upper_arm * direction,
                                0.031f * h_ * s_.thickness + cloth, 0.033f * h_ * s_.thickness + cloth),
                     0.01f);
      return std::max(d, along - 0.56f * s_.upper_arm - hem_room_m);
    }
    d = smooth_min(
        d, round_cone(p, elbow, wrist, 0.0215f * h_ * s_.thickness + cloth, 0.0155f * h_ + cloth + 0.006f),
        0.02f);
    const float around = std::atan2(p.x, p.z);
    d += folds(along - s_.upper_arm, around, 0.075f, 0.0042f) +
         folds(along - whole + 0.03f, around, 0.05f, 0.0035f) + folds(along - 0.05f, around, 0.05f, 0.003f);
    return std::max(d, along - whole - hem_room_m);
  }

  float top_field(vec3 p) const {
    const float cloth = cloth_m();
    const bool is_loose = outfit_.top != Top::t_shirt && outfit_.top != Top::blouse;
    float d = body_.trunk(p, cloth);
    const float low = hem_z();
    if (is_loose || outfit_.top == Top::t_shirt) {  // hangs from the chest
      const float t = glm::clamp((s_.shoulder_z - p.z) / (s_.shoulder_z - s_.hip_z), 0.0f, 1.4f);
      const float half = std::lerp(0.93f * s_.chest_half,
                                   std::max(0.97f * s_.hips_half, 0.9f * s_.chest_half), std::min(t, 1.0f)) +
                         cloth * 0.8f;
      const float depth =
          std::lerp(0.80f * s_.chest_depth, 1.02f * s_.hips_depth, std::min(t, 1.0f)) + cloth * 0.8f;
      const float q = std::sqrt((p.y / half) * (p.y / half) + (p.x / depth) * (p.x / depth));
      const float tube = q > 1e-3f ? glm::length(glm::vec2(p)) * (1.0f - 1.0f / q) : -half;
      d = smooth_min(d, std::max(tube, p.z - std::lerp(s_.hip_z, s_.shoulder_z, 0.78f)), 0.04f * h_);
    }
    if (outfit_.top == Top::coat)
      d = smooth_min(d, hanging(p, low - 0.05f, cloth + 0.004f, 0.055f, 0.006f), 0.03f);
    const float near_hips = std::exp(-std::pow((p.z - low - 0.03f) / 0.08f, 2.0f));
    d += 0.0040f * smooth_noise(p * vec3(9.0f, 9.0f, 14.0f)) +
         0.0065f * smooth_noise(p * vec3(7.0f, 7.0f, 4.0f));
    d += 0.0035f * near_hips * std::sin(2.0f * pi * p.z / 0.12f + 3.0f * p.y / 0.1f);
    // Drawn from the armpits towards the waist.
    const float pull = std::exp(-std::pow((p.z - s_.shoulder_z + 0.13f * h_) / (0.07f * h_), 2.0f)) *
                       fade(0.03f * h_, 0.08f * h_, std::abs(p.y));
    d += 0.0035f * pull * std::sin((p.z + 0.7f * std::abs(p.y)) * 2.0f * pi / 0.11f);
    d = std::max(d, low - hem_room_m - p.z);
    for (const float side : {1.0f, -1.0f})
      d = smooth_min(d, sleeve(p, side, cloth), 0.028f * h_);  // reach below the hem
    if (outfit_.top == Top::pullover)                          // ribbed hem and cuffs
      d += 0.004f * fade(low + 0.060f, low + 0.045f, p.z);
    // The neck opening, and a collar about it.
    const float neck_top = k_.joint[neck].z + 0.012f * h_;
    const vec3 c(k_.joint[neck].x + 0.004f * h_, 0.0f, 0.0f);
    const float girth = 0.255f * s_.head;
    const glm::vec2 q2(p.x - c.x, p.y);
    const float ring_z = neck_top - 0.004f * h_ - 0.42f * (p.x - c.x);
    d = smooth_max(d, p.z - ring_z - 0.012f, 0.012f);
    const bool has_collar = outfit_.top == Top::jacket || outfit_.top == Top::coat;
    const float height = has_collar ? 0.020f : outfit_.top == Top::pullover ? 0.010f : 0.006f;
    const float around = glm::length(q2) - girth - 0.008f;
    const float collar = glm::length(glm::vec2(around, std::max(0.0f, std::abs(p.z - ring_z) - height))) -
                         (has_collar ? 0.009f : 0.007f);
    return smooth_min(d, collar, 0.018f);
  }

  /// Half of the opening of a jacket's front at a height.
  float opening(float z) const {
    const float top = s_.shoulder_z + 0.01f * h_, t = glm::clamp((top - z) / (top - s_.hip_z), 0.0f, 1.2f);
    return h_ * (0.010f + 0.030f * (1.0f - fade(0.0f, 0.62f, t)) + 0.022f * fade(0.62f, 1.1f, t));
  }

  vec3 box_low() const { return {-0.30f * h_, -0.46f * h_, 0.0f}; }
  vec3 box_high() const { return {0.30f * h_, 0.46f * h_, h_}; }

  float cell(float near_m) const { return near_m * detail_ * std::max(0.72f, h_ / 1.75f); }
  /// Cells for legs, which coarse ones would lose: narrow across, as high as others.
  vec3 leg_cell(float near_m) const {
    constexpr float across_m = 0.05f;
    const float usual = cell(near_m), across = std::min(usual, across_m * std::max(0.72f, h_ / 1.75f));
    return {across, across, usual};
  }

  void add(const char* name, Mesh mesh, Surface surface, Moves moves, const Shade& shade) {
    if (mesh.indices.empty()) return;
    mesh.colours.clear();
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      mesh.colours.emplace_back(vec3(shade(mesh.positions[v], mesh.normals[v])), 1.0f);
    // The yarns of trunk and limbs run round the body's axis; where they begin and end, at the back, is the
    // seam.
    mesh.uvs.resize(mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const vec3 p = mesh.positions[v];
      const float round = std::atan2(p.y, p.x) / (2.0f * std::numbers::pi_v<float>);
      mesh.uvs[v] = {cloth_tiles_round * round, p.z / cloth_tile_m};
    }
    garments_.push_back({name, std::move(mesh), surface, moves});
  }

  /// Shade between arms and trunk and in folds: the field a little outside of the cloth is small in crevices.
  Shade crevices(const Field& field) const {
    return [field](vec3 p, vec3 n) {
      // The vertices lie on the field's zeros.
      const float open = field(p + 0.030f * n) / 0.030f, wide = field(p + 0.09f * n) / 0.09f;
      return glm::clamp(0.45f + 0.40f * open + 0.20f * wide, 0.35f, 1.04f);
    };
  }

  void add_top() {
    const Field field = [this](vec3 p) { return top_field(p); };
    vec3 low = box_low(), high = box_high();
    low.z = std::min(hem_z(), k_.joint[left_hand].z) - 0.08f, high.z = s_.chin_z + 0.02f;
    Mesh mesh = surface_net(field, low, high, cell(0.025f));
    if (outfit_.top == Top::jacket || outfit_.top == Top::coat) {
      const float front = 0.015f * h_;
      mesh = clipped(mesh, [this, front](vec3 p) {
        return p.x > front ? opening(p.z) - std::abs(p.y - 0.002f) : -0.01f;
      });
    }
    const float sleeve_end =
        outfit_.top == Top::t_shirt ? 0.56f * s_.upper_arm : s_.upper_arm + s_.forearm - 0.002f;
    const float hem = hem_z();
    mesh = clipped(mesh, [=, this](vec3 p) {
      const float uneven = 0.004f * std::sin(9.0f * std::atan2(p.y, p.x));
      const float side = p.y > 0.0f ? 1.0f : -1.0f, along = body_.along_arm(p, side);
      const vec3 on_arm =
          k_.joint[side > 0.0f ? left_upper_arm : right_upper_arm] + along * Skeleton::arm_direction(side);
      const bool is_sleeve = glm::distance(p, on_arm) < 0.048f * h_ * std::max(1.0f, s_.thickness);
      return is_sleeve ? along - sleeve_end : hem + uneven - p.z;
    });
    add("top", std::move(mesh), top_cloth, Moves::top, crevices(field));
  }

  void add_shirt() {
    const Field field = [this](vec3 p) {
      float d = body_.trunk(p, 0.006f) + 0.003f * smooth_noise(p * vec3(8.0f, 8.0f, 16.0f));
      const float neck_top = k_.joint[neck].z + 0.012f * h_,
                  ring_z = neck_top - 0.55f * (p.x - k_.joint[neck].x);
      d = smooth_max(d, p.z - ring_z - 0.006f, 0.01f);
      const float around =
          glm::length(glm::vec2(p.x - k_.joint[neck].x - 0.004f * h_, p.y)) - 0.255f * s_.head - 0.003f;
      return smooth_min(
          d, glm::length(glm::vec2(around, std::max(0.0f, std::abs(p.z - ring_z) - 0.008f))) - 0.006f, 0.01f);
    };
    vec3 low(0.0f, -0.09f * h_, s_.hip_z - 0.05f * h_), high(0.2f * h_, 0.09f * h_, s_.chin_z);
    Mesh mesh = surface_net(field, low, high, cell(0.022f));
    add("shirt", std::move(mesh), shirt, Moves::top, [](vec3, vec3) { return 0.9f; });
  }

  void add_arms() {
    for (const float side : {1.0f, -1.0f}) {
      const Field field = [this, side](vec3 p) {
        const float along = body_.along_arm(p, side);
        return std::max({body_.arm(p, side, 0.0f), 0.42f * s_.upper_arm - along,
                         along - s_.upper_arm - s_.forearm - 0.004f * h_});
      };
      const vec3 low(-0.1f * h_, side > 0.0f ? 0.08f * h_ : -0.46f * h_, s_.shoulder_z - 0.36f * h_),
          high(0.1f * h_, low.y + 0.38f * h_, s_.shoulder_z);
      add("arm", surface_net(field, low, high, cell(0.020f)), skin, Moves::top,
          [](vec3, vec3) { return 1.0f; });
    }
  }

  float trouser_field(vec3 p) const {
    const bool is_slim = outfit_.bottom == Bottom::jeans, is_short = outfit_.bottom == Bottom::shorts;
    const float cloth = is_slim ? 0.008f : 0.012f;
    const float waist = s_.hip_z + 0.085f * h_, low = is_short ? s_.knee_z + 0.02f * h_ : 0.030f;
    const float over_blouse = outfit_.top == Top::blouse ? 0.021f : 0.005f;
    float d = smooth_max(body_.trunk(p, over_blouse), p.z - waist, 0.01f);
    std::array<float, 2> legs{};
    for (const std::size_t i : {0u, 1u}) {
      const float side = i == 0 ? 1.0f : -1.0f;
      const std::size_t first = i == 0 ? left_thigh : right_thigh;
      const vec3 knee = k_.joint[first + 1], ankle = k_.joint[first + 2];
      float leg = body_.leg(p, side, cloth);
      if (!is_slim) {
        const float width = is_short ? 0.044f : 0.0345f;
        leg = smooth_min(leg,
                         round_cone(p, glm::mix(k_.joint[first], knee, 0.35f), knee,
                                    0.044f * h_ * s_.thickness + cloth, 0.036f * h_ * s_.thickness + cloth),
                         0.01f);
        leg = smooth_min(leg,
                         round_cone(p, knee, ankle - vec3(0, 0, 0.06f), 0.035f * h_ * s_.thickness + cloth,
                                    width * h_ + 0.006f),
                         0.02f);
      } else {
        leg = smooth_min(leg,
                         round_cone(p, glm::mix(knee, ankle, 0.6f), ankle - vec3(0, 0, 0.06f),
                                    0.024f * h_ + cloth, 0.026f * h_ + 0.004f),
                         0.02f);
      }
      const float around = std::atan2(p.y - knee.y, p.x - knee.x);
      leg += folds(p.z - s_.knee_z, around, 0.09f, is_slim ? 0.0035f : 0.0045f);
      if (!is_short) {
        leg += folds(p.z - low - 0.03f, around + 1.0f, 0.065f, 0.0050f);
        leg -= 0.004f * std::exp(-std::pow((p.z - low - 0.05f) / 0.05f, 2.0f));
      }
      leg += 0.0045f * smooth_noise(p * vec3(7.0f, 7.0f, 5.0f) + vec3(0, 0, 7.0f * side));
      // The crease of pressed trousers.
      if (!is_slim && !is_short)
        leg -= 0.0035f * std::exp(-std::pow((p.y - knee.y) / 0.012f, 2.0f)) * (p.x > knee.x ? 1.0f : 0.6f) *
               fade(s_.hip_z, s_.hip_z - 0.1f, p.z);
      legs[i] = leg;
    }
    const float both = smooth_min(legs[0], legs[1], 0.012f * h_);
    d = smooth_min(d, both, 0.032f * h_);
    // Drawn from the crotch to the hips.
    const float near_crotch = std::exp(-std::pow((p.z - s_.hip_z + 0.035f * h_) / (0.045f * h_), 2.0f));
    d += 0.0032f * near_crotch * std::sin(2.0f * pi * (p.z - 0.55f * std::abs(p.y)) / 0.10f);
    d = smooth_max(d, p.z - waist, 0.008f);
    return std::max(d, low - hem_room_m - p.z);
  }

  void add_bottom() {
    if (!wears_skirt()) {
      const Field field = [this](vec3 p) { return trouser_field(p); };
      vec3 low = box_low(), high = box_high();
      low.y = -0.24f * h_, high.y = 0.24f * h_, low.z = -0.06f, high.z = s_.hip_z + 0.12f * h_;
      const float hem = outfit_.bottom == Bottom::shorts ? s_.knee_z + 0.02f * h_ : 0.030f;
      Mesh mesh = clipped(surface_net(field, low, high, leg_cell(0.028f)),
                          [hem](vec3 p) { return hem + 0.05f * p.x - p.z; });
      add("trousers", std::move(mesh), bottom_cloth, Moves::bottom, crevices(field));
      if (outfit_.bottom == Bottom::shorts) add_bare_legs(s_.knee_z + 0.06f * h_, skin);
      return;
    }
    const bool is_long = outfit_.bottom == Bottom::dress;
    const float hem = s_.knee_z + (is_long ? -0.06f : 0.03f) * h_;
    const Field field = [this, hem, is_long](vec3 p) {
      float d = hanging(p, hem, outfit_.top == Top::blouse ? 0.024f : 0.008f, is_long ? 0.085f : 0.045f,
                        is_long ? 0.014f : 0.007f);
      d += 0.003f * smooth_noise(p * vec3(8.0f, 8.0f, 3.0f));
      return d;
    };
    vec3 low = box_low(), high = box_high();
    low.y = -0.3f * h_, high.y = 0.3f * h_, low.z = hem - 0.08f, high.z = s_.hip_z + 0.2f * h_;
    add("skirt",
        clipped(surface_net(field, low, high, cell(0.028f)),
                [hem](vec3 p) { return hem + 0.006f * std::sin(5.0f * std::atan2(p.y, p.x)) - p.z; }),
        bottom_cloth, Moves::skirt, crevices(field));
    add_bare_legs(hem + 0.07f * h_, skin);
  }

  void add_bare_legs(float top, Surface surface) {
    const Field field = [this, top](vec3 p) {
      return std::max(
          {std::min(body_.leg(p, 1.0f, 0.0f), body_.leg(p, -1.0f, 0.0f)), p.z - top, 0.035f - p.z});
    };
    vec3 low(-0.1f * h_, -0.2f * h_, 0.0f), high(0.1f * h_, 0.2f * h_, top + 0.03f);
    add("legs", surface_net(field, low, high, leg_cell(0.023f)), surface, Moves::bottom,
        [](vec3, vec3) { return 1.0f; });
  }

  /// A relaxed hand; `p` along the fingers, towards the thumb, out of the back of the hand; metres of a hand
  /// of 0.19 m.
  static float hand(vec3 p, bool is_simple) {
    if (is_simple)
      return std::min(round_cone(p, {0.0f, 0, 0}, {0.08f, 0, 0}, 0.03f, 0.036f),
                      round_cone(p, {0.08f, 0, 0}, {0.15f, 0, -0.03f}, 0.034f, 0.02f));
    const vec3 flat(p.x, p.y, p.z * 1.9f);
    float d = round_cone(flat, {-0.03f, 0.0f, 0.0f}, {0.02f, 0.0f, 0.0f}, 0.0265f, 0.029f) / 1.35f;
    const float y_knuckle[4]{0.029f, 0.0095f, -0.0105f, -0.0285f},
        x_knuckle[4]{0.091f, 0.095f, 0.091f, 0.083f}, length[4]{0.071f, 0.079f, 0.073f, 0.057f},
        radius[4]{0.0090f, 0.0092f, 0.0088f, 0.0078f};
    for (int i = 0; i < 4; ++i)
      d = smooth_min(d,
                     round_cone(p, {0.010f, 0.6f * y_knuckle[i], -0.002f},
                                {x_knuckle[i] - 0.006f, y_knuckle[i], 0.0f}, 0.0135f, 0.0115f),
                     0.012f);
    d = smooth_min(d, round_cone(p, {0.018f, 0.020f, -0.006f}, {0.050f, 0.034f, -0.012f}, 0.0155f, 0.013f),
                   0.014f);
    float fingers = 1e9f;
    for (int i = 0; i < 4; ++i) {
      vec3 at(x_knuckle[i] - 0.008f, y_knuckle[i], 0.001f);
      float bend = 0.22f + 0.07f * float(i);
      const float parts[3]{0.50f, 0.29f, 0.23f}, more[3]{0.0f, 0.42f + 0.04f * float(i), 0.30f};
      float finger = 1e9f, r = radius[i];
      for (int j = 0; j < 3; ++j) {
        bend += more[j];
        const vec3 to = at + parts[j] * (length[i] + 0.004f) *
                                 vec3(std::cos(bend), 0.06f * (1.2f - float(i)), -std::sin(bend));
        const float thinner = r * (j == 2 ? 0.86f : 0.94f);
        finger = smooth_min(finger, round_cone(p, at, to, r, thinner), 0.003f);
        at = to, r = thinner;
      }
      fingers = std::min(fingers, finger);
    }
    d = smooth_min(d, fingers, 0.006f);
    const vec3 t0(0.040f, 0.036f, -0.012f), t1(0.068f, 0.050f, -0.021f), t2(0.092f, 0.054f, -0.031f);
    d = smooth_min(
        d,
        smooth_min(round_cone(p, t0, t1, 0.0125f, 0.0100f), round_cone(p, t1, t2, 0.0100f, 0.0078f), 0.003f),
        0.009f);
    return d;
  }

  void add_hands() {
    const float size = s_.hand / 0.19f;
    const bool is_simple = detail_ > 2.5f;
    for (const float side : {1.0f, -1.0f}) {
      const std::size_t bone = side > 0.0f ? left_hand : right_hand;
      const vec3 along = Skeleton::arm_direction(side), thumb(1, 0, 0),
                 back = glm::cross(along, thumb) * -side;
      const vec3 wrist = k_.joint[bone];
      const Field field = [=](vec3 p) {
        const vec3 q = (p - wrist) / size;
        const vec3 local(glm::dot(q, along), glm::dot(q, thumb), glm::dot(q, back));
        return size * std::max(hand(local, is_simple), -0.035f - local.x);
      };
      const vec3 reach(0.11f * size), middle = wrist + 0.06f * size * along;
      const float cell_m = (is_simple ? 0.034f : 0.0084f * std::pow(detail_, 0.8f)) * size;
      add("hand",
          surface_net(field, middle - reach - vec3(0, 0.02f, 0.02f), middle + reach + vec3(0, 0.02f, 0.02f),
                      cell_m),
          skin, side > 0.0f ? Moves::hand_left : Moves::hand_right, [=](vec3 p, vec3 n) {
            return glm::clamp(0.70f + 30.0f * (field(p + 0.012f * n) - 0.002f), 0.6f, 1.0f);
          });
    }
  }

  void add_shoes() {
    const float size = s_.foot / 0.267f;
    const bool is_low = wears_skirt();
    for (const float side : {1.0f, -1.0f}) {
      const vec3 ankle = k_.joint[side > 0.0f ? left_foot : right_foot];
      const float heel = k_.heel_x, y = ankle.y, out = 0.008f * side * size;
      const float toe = ankle.x + 0.73f * s_.foot + 0.012f, ball = k_.ball_x;
      const Field field = [=, this](vec3 p) {
        float d = ellipsoid(p, {ankle.x + heel + 0.040f * size, y, 0.038f * size},
                            vec3(0.046f, 0.036f, 0.050f) * size);
        d = smooth_min(d,
                       round_cone(p, {ankle.x + heel + 0.05f * size, y, 0.040f * size},
                                  {ball, y + out, 0.034f * size}, 0.035f * size, 0.0385f * size),
                       0.02f * size);
        d = smooth_min(d,
                       ellipsoid(p, {toe - 0.058f * size, y + 0.5f * out, 0.027f * size},
                                 vec3(0.062f, 0.043f, 0.029f) * size),
                       0.03f * size);
        if (!is_low) {
          d = smooth_min(
              d,
              round_cone(p, {ankle.x, y, 0.09f * size}, {ball - 0.035f * size, y + 0.5f * out, 0.050f * size},
                         0.036f * size, 0.026f * size),
              0.03f * size);
          d = smooth_max(d, p.z - 0.098f * size, 0.01f);
        } else {
          d = smooth_max(d, p.z - 0.052f * size - 0.25f * std::max(0.0f, ankle.x - p.x), 0.006f);
        }
        if (p.z < 0.020f * size) d -= 0.003f * size;  // the sole stands out
        return smooth_max(d, 0.001f - p.z, 0.006f);
      };
      const vec3 low(ankle.x + heel - 0.04f, y - 0.07f, -0.03f), high(toe + 0.04f, y + 0.07f, 0.13f * size);
      const float step = detail_ > 2.5f ? 0.032f * size : 0.0135f * std::pow(detail_, 0.9f) * size;
      add("shoe", surface_net(field, low, high, step), shoe, Moves::shoes,
          [size](vec3 p, vec3) { return p.z < 0.021f * size ? 0.35f : 1.0f; });
      if (is_low) {
        const Field foot = [=](vec3 p) {
          float d = round_cone(p, {ankle.x + heel + 0.045f * size, y, 0.045f * size},
                               {ankle.x, y, 0.09f * size}, 0.030f * size, 0.036f * size);
          d = smooth_min(d,
                         round_cone(p, {ankle.x, y, 0.075f * size}, {ball - 0.01f, y + out, 0.034f * size},
                                    0.033f * size, 0.028f * size),
                         0.02f * size);
          return std::max({d, p.z - 0.13f * size, 0.03f * size - p.z});
        };
        add("instep", surface_net(foot, low, high + vec3(0, 0, 0.05f), cell(0.014f)), skin, Moves::shoes,
            [](vec3, vec3) { return 1.0f; });
      }
    }
  }

  void add_bag() {
    if (outfit_.bag == Bag::none) return;
    const bool is_backpack = outfit_.bag == Bag::backpack;
    const float cloth = cloth_m() + 0.004f, chest = std::lerp(s_.hip_z, s_.shoulder_z, 0.62f);
    const TrunkStation at_chest = body_.station(chest);
    Field field;
    if (is_backpack) {
      const float scale = std::max(0.78f, h_ / 1.75f), x = -at_chest.back - cloth - 0.065f * scale;
      field = [=, this](vec3 p) {
        float d = rounded_box(p - vec3(x, 0.0f, chest + 0.01f), vec3(0.075f, 0.145f, 0.215f) * scale,
                              0.055f * scale);
        d = smooth_min(d,
                       rounded_box(p - vec3(x - 0.055f * scale, 0.0f, chest - 0.075f * scale),
                                   vec3(0.05f, 0.11f, 0.10f) * scale, 0.035f * scale),
                       0.012f);
        // Straps a finger thick lie on the cloth.
        const float on_cloth = std::abs(body_.trunk(p, cloth + 0.008f)) - 0.015f;
        const float line =
            std::abs(std::abs(p.y) - 0.046f * h_ - 0.05f * std::max(0.0f, s_.shoulder_z - p.z)) - 0.024f;
        const float strap = smooth_max(smooth_max(on_cloth, line, 0.006f), chest - 0.03f * h_ - p.z, 0.01f);
        return smooth_min(d, p.x > -at_chest.back ? strap : std::max(strap, chest + 0.1f - p.z), 0.008f);
      };
    } else {
      const float y = -s_.hips_half - cloth - 0.055f;
      field = [=, this](vec3 p) {
        float d = rounded_box(p - vec3(0.0f, y, s_.hip_z + 0.015f * h_), vec3(0.15f, 0.050f, 0.115f), 0.032f);
        d = smooth_min(
            d,
            rounded_box(p - vec3(0.0f, y - 0.03f, s_.hip_z + 0.05f * h_), vec3(0.15f, 0.028f, 0.075f), 0.02f),
            0.006f);
        // The strap: a plane from the bag over the other shoulder.
        const vec3 from(0.0f, y + 0.03f, s_.hip_z + 0.07f * h_),
            to(0.0f, 0.055f * h_, s_.shoulder_z + 0.03f * h_);
        const vec3 along = glm::normalize(to - from),
                   across = glm::normalize(glm::cross(along, vec3(1, 0, 0)));
        const float strap = smooth_max(std::abs(body_.trunk(p, cloth + 0.008f)) - 0.015f,
                                       std::abs(glm::dot(p - from, across)) - 0.022f, 0.008f);
        return smooth_min(d, std::max(strap, s_.hip_z + 0.04f * h_ - p.z), 0.006f);
      };
    }
    vec3 low(-0.26f * h_, -0.24f * h_, s_.hip_z - 0.1f * h_), high(0.2f * h_, 0.2f * h_, s_.chin_z);
    add("bag", surface_net(field, low, high, cell(0.018f)), accessory, Moves::top, crevices(field));
  }

  const BodyField& body_;
  const BodyShape& s_;
  const Skeleton& k_;
  const Outfit& outfit_;
  float detail_, h_;
  std::vector<Garment> garments_;
};

}  // namespace

Image8 cloth_texture(int size) {
  constexpr int yarn_px = 4;  // 1.6 mm
  constexpr float mean = 0.86f, of_yarns = 0.13f, of_weave = 0.08f;
  Image8 image(size, size, 4, 255);
  // Each yarn has a tone of its own, which changes along it; every other one lies on top.
  const auto tone = [size](int yarn, int along, int use) {
    const int yarns = size / yarn_px;
    std::uint32_t x = std::uint32_t(yarn % yarns) * 0x9e3779b9u + std::uint32_t(along / 24) * 0x85ebca6bu +
                      std::uint32_t(use);
    x ^= x >> 16, x *= 0x7feb352du, x ^= x >> 15, x *= 0x846ca68bu, x ^= x >> 16;
    return float(x >> 8) / float(1u << 24) - 0.5f;
  };
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const int column = x / yarn_px, row = y / yarn_px;
      const bool is_warp = (column + row) % 2 == 0;
      const int across = (is_warp ? x : y) % yarn_px;
      const float round = 1.0f - std::abs((float(across) + 0.5f) / (0.5f * float(yarn_px)) - 1.0f);
      const float value =
          mean + of_yarns * (is_warp ? tone(column, y, 1) : tone(row, x, 2)) + of_weave * (round - 0.5f);
      const float shown = srgb_from_linear(glm::clamp(value, 0.0f, 1.0f));
      for (int i = 0; i < 3; ++i) image.at(x, y)[i] = std::uint8_t(255.0f * shown + 0.5f);
    }
  return image;
}

std::vector<Garment> dressed(const BodyField& body, const Outfit& outfit, float detail) {
  return Tailor(body, outfit, detail).dress();
}

}  // namespace parvis::people
