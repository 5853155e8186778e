#include "life/people/head.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/colour.h"

namespace parvis::people {
namespace {

using glm::vec3;

const vec3 centre_of_grid(0.03f, 0.0f, 0.43f);
constexpr float face_reach = 0.85f, hair_reach = 1.25f;  // from where rays begin, which surfaces do not pass
constexpr float neck_rows = 0.13f;                       // the fraction of rows below the jaw
constexpr float neck_x = -0.15f, neck_low = -0.36f, neck_high = -0.05f;

float soft_step(float from, float to, float x) {
  const float t = glm::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}
constexpr float far_out = 9.0f;  // beyond it a bump is below 1.3e-4
float bump_of_square(float square) { return square < far_out ? std::exp(-square) : 0.0f; }
float bump(float x, float width) { return bump_of_square((x / width) * (x / width)); }
float bump(vec3 p, vec3 middle, float width) {
  const vec3 d = (p - middle) / width;
  return bump_of_square(glm::dot(d, d));
}

/// A ray of the grid: `u` around from the back, 0..1, `v` from the neck, 0, to the vertex, 1.
struct GridRay {
  vec3 origin, direction;
};
float azimuth_of(float u) {
  const float s = 2.0f * u - 1.0f;  // 0: in front
  return pi * (0.58f * s + 0.42f * s * s * s);
}
GridRay ray_of(float u, float v) {
  const float azimuth = azimuth_of(u);
  const vec3 out(std::cos(azimuth), std::sin(azimuth), 0.0f);
  if (v < neck_rows) return {{neck_x, 0.0f, std::lerp(neck_low, neck_high, v / neck_rows)}, out};
  const float t = (v - neck_rows) / (1.0f - neck_rows);
  const float front = 0.5f + 0.5f * std::cos(azimuth),
              lowest = std::lerp(-0.86f, -1.38f, soft_step(0.3f, 0.9f, front));
  const float elevation = std::lerp(lowest, 0.5f * pi, t * (0.64f + 0.36f * t * t));
  return {centre_of_grid, std::cos(elevation) * out + vec3(0, 0, std::sin(elevation))};
}

/// Where the ray comes upon the surface from outside, at most `t` along it.
template <class Distance>
vec3 cast(const GridRay& ray, const Distance& distance, float t) {
  for (int i = 0; i < 60 && t > 0.02f; ++i) {
    const float d = distance(ray.origin + t * ray.direction);
    if (d < 4e-4f) break;
    t -= std::max(0.7f * d, 2e-4f);
  }
  return ray.origin + std::max(t, 0.02f) * ray.direction;
}

/// A grid of vertices as triangles; the first and the last column coincide.
Mesh grid_mesh(int columns, int rows,
               const std::function<void(float u, float v, vec3& position, vec3& normal)>& at) {
  Mesh mesh;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) {
      const float u = float(c) / float(columns), v = float(r) / float(rows);
      vec3 position, normal;
      at(u, v, position, normal);
      mesh.positions.push_back(position), mesh.normals.push_back(normal);
      mesh.uvs.push_back({u, 1.0f - v});
    }
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const auto a = std::uint32_t(r * (columns + 1) + c), b = a + 1, d = a + std::uint32_t(columns) + 1,
                 e = d + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, e, a, e, d});
    }
  return mesh;
}

/// The height above which hair grows, by the angle from the front; rounded between the given ones.
float hairline_height(float angle, bool covers_ears) {
  struct At {
    float deg, z, z_long;
  };
  constexpr std::array<At, 10> heights{{{0, 0.86f, 0.87f},
                                        {28, 0.83f, 0.84f},
                                        {48, 0.72f, 0.70f},
                                        {60, 0.62f, 0.46f},
                                        {72, 0.47f, 0.05f},
                                        {86, 0.56f, -0.25f},
                                        {104, 0.57f, -0.5f},
                                        {118, 0.40f, -0.5f},
                                        {142, 0.20f, -0.5f},
                                        {180, 0.13f, -0.5f}}};
  const float deg = std::abs(glm::degrees(angle));
  for (std::size_t i = 1; i < heights.size(); ++i) {
    if (deg > heights[i].deg) continue;
    const float t = soft_step(heights[i - 1].deg, heights[i].deg, deg);
    return covers_ears ? std::lerp(heights[i - 1].z_long, heights[i].z_long, t)
                       : std::lerp(heights[i - 1].z, heights[i].z, t);
  }
  return covers_ears ? heights.back().z_long : heights.back().z;
}

bool covers_ears(HairStyle style) { return style == HairStyle::bob || style == HairStyle::long_hair; }

float thickness(HairStyle style) {
  switch (style) {
    case HairStyle::bald:
      return 0.0f;
    case HairStyle::cropped:
      return 0.030f;
    case HairStyle::parted:
      return 0.075f;
    case HairStyle::bob:
      return 0.075f;
    case HairStyle::long_hair:
      return 0.065f;
    case HairStyle::bun:
    case HairStyle::pony_tail:
      return 0.035f;
  }
  return 0.0f;
}

}  // namespace

HeadField::HeadField(const BodyField& body, const HeadLook& look) : look_(look), size_m_(body.shape().head) {
  const float forward = look.age > 65.0f ? 0.012f : 0.0f;  // old necks lean
  origin_ = {body.skeleton().joint[neck].x - neck_x * size_m_ + forward, 0.0f, body.shape().chin_z};
}

float HeadField::skull(vec3 q) const {
  const vec3 p(q.x, std::abs(q.y), q.z);
  const HeadLook& l = look_;
  const float male = l.is_female ? 0.0f : 1.0f;
  float d = ellipsoid(p, {-0.045f, 0.0f, 0.655f}, {0.425f, 0.322f, 0.345f});
  d = smooth_min(d, ellipsoid(p, {0.085f, 0.0f, 0.48f}, {0.272f, 0.252f + 0.012f * l.cheeks, 0.39f}), 0.12f);
  // Jaw and chin.
  const float gonion = 0.200f + 0.022f * l.jaw + 0.012f * male;
  d = smooth_min(
      d, round_cone(p, {0.01f, gonion, 0.22f}, {0.235f, 0.06f + 0.02f * male, 0.075f}, 0.055f, 0.062f),
      0.11f);
  d = smooth_min(
      d, ellipsoid(p, {0.262f + 0.012f * l.jaw, 0.0f, 0.078f}, {0.078f, 0.088f + 0.02f * male, 0.072f}),
      0.07f);
  d = smooth_min(d, round_cone(p, {0.05f, 0.10f, 0.10f}, {0.22f, 0.05f, 0.07f}, 0.07f, 0.06f), 0.10f);
  if (p.x > 0.0f) d = front(p, d);
  // Neck: it leans forward, and is wider than deep.
  const float girth = l.is_female ? 0.205f : 0.245f;
  const vec3 thin(p.x, 0.96f * p.y, p.z);
  d = smooth_min(
      d, round_cone(thin, {-0.10f, 0.0f, 0.22f}, {neck_x - 0.03f, 0.0f, -0.45f}, girth - 0.01f, girth),
      0.09f);
  if (p.z > 0.5f) return d;
  d = smooth_min(d, round_cone(p, {-0.12f, 0.195f, 0.16f}, {0.02f, 0.05f, -0.36f}, 0.035f, 0.04f), 0.07f);
  if (!l.is_female) d = smooth_min(d, glm::distance(p, vec3(0.088f, 0.0f, -0.13f)) - 0.030f, 0.06f);
  return d;
}

/// The features of the face that stand out in front; they reach no place behind the ears.
float HeadField::front(vec3 p, float d) const {
  const HeadLook& l = look_;
  const float male = l.is_female ? 0.0f : 1.0f;
  // Cheek bones, and the flesh below them.
  d = smooth_min(d, ellipsoid(p, {0.215f, 0.170f, 0.425f}, {0.100f, 0.085f + 0.01f * l.cheeks, 0.075f}),
                 0.10f);
  d = smooth_min(d, ellipsoid(p, {0.215f, 0.125f, 0.27f}, {0.105f, 0.09f + 0.025f * l.cheeks, 0.12f}), 0.09f);
  // Brows.
  d = smooth_min(
      d, round_cone(p, {0.318f, 0.055f, 0.600f}, {0.238f, 0.205f, 0.595f}, 0.030f + 0.008f * male, 0.024f),
      0.07f);
  // Sockets, and lids over the eyeballs in them.
  d = smooth_max(d, -ellipsoid(p, {0.372f, 0.146f, 0.515f}, {0.080f, 0.082f, 0.062f}), 0.055f);
  d = smooth_min(d, glm::distance(p, vec3(0.252f, 0.146f, 0.512f)) - 0.0585f - 0.003f * l.eyes, 0.022f);
  // Mouth over the teeth.
  return smooth_min(d, ellipsoid(p, {0.262f, 0.0f, 0.225f}, {0.090f, 0.130f, 0.105f}), 0.08f);
}

float HeadField::face(vec3 q) const {
  const vec3 p(q.x, std::abs(q.y), q.z);
  float d = skull(q);
  if (p.x > 0.2f) d = nose_and_lips(p, d);
  if (p.y < 0.2f) return d;
  // Ears: a shell with a concave middle.
  const float turned = 0.28f;
  const vec3 e = p - vec3(-0.035f, 0.306f, 0.466f);
  const vec3 ear(std::cos(turned) * e.x + std::sin(turned) * e.y,
                 std::cos(turned) * e.y - std::sin(turned) * e.x, e.z);
  float shell = ellipsoid(ear, {-0.005f, 0.0f, 0.0f}, {0.070f, 0.024f, 0.125f});
  shell = smooth_max(shell, -ellipsoid(ear, {0.012f, 0.032f, 0.012f}, {0.042f, 0.026f, 0.080f}), 0.016f);
  return smooth_min(d, shell, 0.018f);
}

float HeadField::nose_and_lips(vec3 p, float d) const {
  const HeadLook& l = look_;
  // Nose: bridge, tip, wings; nostrils.
  const float longer = 0.022f * l.nose;
  const vec3 tip(0.452f + longer, 0.0f, 0.340f - 0.4f * longer);
  d = smooth_min(
      d, round_cone(p, {0.318f, 0.0f, 0.545f}, {tip.x - 0.022f, 0.0f, tip.z + 0.03f}, 0.024f, 0.032f), 0.04f);
  d = smooth_min(d, glm::distance(p, tip) - 0.036f - 0.004f * l.nose, 0.035f);
  d = smooth_min(
      d, ellipsoid(p, {0.376f + 0.4f * longer, 0.054f + 0.008f * l.nose, 0.322f}, {0.044f, 0.027f, 0.030f}),
      0.022f);
  d = smooth_max(d, -ellipsoid(p, {0.412f + 0.6f * longer, 0.029f, 0.290f}, {0.026f, 0.013f, 0.018f}),
                 0.012f);
  // Lips: two rolls with a line between them, the groove above, the dimple below.
  const float full = 1.0f + 0.35f * l.lips + (l.is_female ? 0.15f : 0.0f);
  d = smooth_min(d, round_cone(p, {0.347f, 0.016f, 0.214f}, {0.292f, 0.105f, 0.201f}, 0.0165f * full, 0.007f),
                 0.022f);
  d = smooth_min(d, round_cone(p, {0.340f, 0.0f, 0.182f}, {0.290f, 0.100f, 0.196f}, 0.0195f * full, 0.007f),
                 0.022f);
  d = smooth_max(d, -round_cone(p, {0.372f, 0.0f, 0.199f}, {0.318f, 0.112f, 0.1985f}, 0.007f, 0.005f),
                 0.012f);
  d = smooth_max(d, -round_cone(p, {0.372f, 0.0f, 0.275f}, {0.375f, 0.0f, 0.235f}, 0.010f, 0.011f), 0.03f);
  d = smooth_max(d, -round_cone(p, {0.352f, 0.0f, 0.140f}, {0.335f, 0.06f, 0.140f}, 0.016f, 0.012f), 0.05f);
  if (l.age > 50.0f)  // folds beside the nose
    d = smooth_max(d, -round_cone(p, {0.352f, 0.085f, 0.315f}, {0.312f, 0.142f, 0.20f}, 0.006f, 0.004f),
                   0.03f);
  return d;
}

float HeadField::hairline(vec3 p) const {
  const float angle = std::atan2(p.y, p.x - centre_of_grid.x);
  float height = hairline_height(angle, covers_ears(look_.style));
  if (!look_.is_female && look_.age > 45.0f)  // receding at the temples
    height += 0.05f * bump(std::abs(angle) - 0.55f, 0.3f);
  if (look_.style == HairStyle::parted) height -= 0.03f * bump(angle - 0.35f, 0.35f);
  return height + 0.010f * smooth_noise(p * 38.0f) - p.z;
}

float HeadField::hair(vec3 p) const {
  const float depth = -hairline(p), full = thickness(look_.style);
  const float swell =
      1.0f + 0.30f * smooth_noise(p * 5.0f) + 0.12f * smooth_noise(p * vec3(16.0f, 16.0f, 6.0f));
  float d = skull(p) - full * swell * soft_step(-0.01f, 0.16f, depth) + 0.004f;
  if (look_.style == HairStyle::parted)  // higher on one side of the parting
    d -= 0.035f * bump(p, {0.20f, 0.06f, 0.95f}, 0.22f);
  if (covers_ears(look_.style)) {
    const bool is_long = look_.style == HairStyle::long_hair;
    const float low = is_long ? -0.42f : 0.02f;
    const vec3 middle(-0.155f, 0.0f, 0.5f * (0.75f + low));
    const float wave = 0.012f * std::sin(24.0f * p.z + 9.0f * p.y) + 0.02f * smooth_noise(p * 7.0f);
    d = smooth_min(d, ellipsoid(p, middle, {0.350f + wave, 0.345f + wave, 0.62f * (0.85f - low)}), 0.10f);
  }
  if (look_.style == HairStyle::bun)
    d = smooth_min(d, glm::distance(p, vec3(-0.47f, 0.0f, 0.80f)) - 0.115f, 0.04f);
  if (look_.style == HairStyle::pony_tail) {
    d = smooth_min(d, round_cone(p, {-0.44f, 0.0f, 0.74f}, {-0.56f, 0.0f, 0.60f}, 0.06f, 0.085f), 0.04f);
    d = smooth_min(d, round_cone(p, {-0.56f, 0.0f, 0.60f}, {-0.50f, 0.0f, 0.16f}, 0.085f, 0.035f), 0.04f);
  }
  return d;
}

Mesh head_mesh(const HeadField& field, int columns, int rows) {
  const Field distance = [&](vec3 p) { return field.face(p); };
  return grid_mesh(columns, rows, [&](float u, float v, vec3& position, vec3& normal) {
    const vec3 p = cast(ray_of(u, v), distance, face_reach);
    position = field.in_model(p), normal = normal_of(distance, p, 0.006f);
  });
}

Mesh hair_mesh(const HeadField& field, const HeadLook& look, int columns, int rows) {
  if (look.style == HairStyle::bald) return {};
  const Field distance = [&](vec3 p) { return field.hair(p); };
  std::vector<vec3> unit;
  Mesh mesh = grid_mesh(columns, rows, [&](float u, float v, vec3& position, vec3& normal) {
    const float azimuth = 2.0f * pi * (u - 0.5f);
    const float elevation = std::lerp(-1.25f, 0.5f * pi, v);
    const GridRay ray{{-0.06f, 0.0f, 0.50f},
                      std::cos(elevation) * vec3(std::cos(azimuth), std::sin(azimuth), 0.0f) +
                          vec3(0, 0, std::sin(elevation))};
    const vec3 p = cast(ray, distance, hair_reach);
    unit.push_back(p);
    position = p, normal = normal_of(distance, p, 0.012f);
  });
  for (glm::vec2& uv : mesh.uvs) uv *= glm::vec2(5.0f, 1.0f);
  const float low = look.style == HairStyle::bob ? -0.02f : -0.44f;
  mesh = clipped(
      mesh, [&](vec3 p) { return std::max(field.hairline(p), low + 0.02f * smooth_noise(p * 9.0f) - p.z); });
  for (vec3& p : mesh.positions) p = field.in_model(p);
  return mesh;
}

namespace {

/// The colour of the skin at a place of the face, linear.
vec3 face_colour(const HeadLook& l, vec3 q, const HeadField& field) {
  const vec3 p(q.x, std::abs(q.y), q.z);
  // The scalp under the hair.
  const float scalp = l.style == HairStyle::bald || (covers_ears(l.style) && q.z < 0.4f)
                          ? 0.0f
                          : soft_step(0.015f, -0.02f, field.hairline(q));
  if (scalp >= 1.0f) return glm::mix(l.skin, l.hair, 0.85f);
  vec3 colour = l.skin * (1.0f + 0.05f * smooth_noise(q * 22.0f) + 0.03f * smooth_noise(q * 70.0f));
  const auto tint = [&](vec3 factor, float part) {
    colour *= glm::mix(vec3(1.0f), factor, glm::clamp(part, 0.0f, 1.0f));
  };
  const auto cover = [&](vec3 with, float part) {
    colour = glm::mix(colour, with, glm::clamp(part, 0.0f, 1.0f));
  };
  const bool is_front = q.x > 0.12f;
  // Blood: cheeks, nose, ears, chin.
  tint({1.10f, 0.80f, 0.76f}, 0.55f * bump(p, {0.25f, 0.18f, 0.36f}, 0.12f));
  tint({1.08f, 0.78f, 0.74f}, 0.6f * bump(p, {0.44f, 0.0f, 0.33f}, 0.07f));
  tint({1.05f, 0.82f, 0.80f}, 0.6f * bump(p, {-0.03f, 0.36f, 0.46f}, 0.12f));
  tint({1.04f, 0.90f, 0.88f}, 0.4f * bump(p, {0.33f, 0.0f, 0.08f}, 0.07f));
  // What hardly sees the sky.
  tint(vec3(0.70f, 0.62f, 0.60f), soft_step(0.05f, -0.10f, q.z) * 0.5f);
  tint({0.78f, 0.66f, 0.64f}, 0.75f * bump(p, {0.30f, 0.105f, 0.535f}, 0.05f));
  tint({0.86f, 0.74f, 0.70f},
       (0.3f + (l.age > 50.0f ? 0.3f : 0.0f)) * bump(p, {0.29f, 0.15f, 0.462f}, 0.035f));
  tint({0.66f, 0.52f, 0.50f}, 0.8f * bump(p, {0.0f, 0.345f, 0.475f}, 0.05f));
  if (is_front) {
    tint({0.12f, 0.06f, 0.05f},
         0.95f * soft_step(0.022f, 0.010f,
                           glm::length((p - vec3(0.410f, 0.029f, 0.293f)) * vec3(0.6f, 1.0f, 1.5f))));
    tint({0.78f, 0.64f, 0.62f}, 0.5f * bump(p.z - 0.288f, 0.018f) * soft_step(0.10f, 0.05f, p.y));
  }
  // Age: lines of forehead, eyes and mouth.
  const float old = soft_step(42.0f, 75.0f, l.age);
  if (old > 0.0f && is_front) {
    float lines = 0.0f;
    for (const float z : {0.70f, 0.735f, 0.77f})
      lines +=
          bump(p.z - z - 0.006f * std::sin(14.0f * p.y + 40.0f * z), 0.0055f) * soft_step(0.17f, 0.11f, p.y);
    for (const float tilt : {-0.35f, 0.0f, 0.35f})
      lines += bump(p.z - 0.505f - tilt * (p.y - 0.20f), 0.005f) * soft_step(0.205f, 0.225f, p.y) *
               soft_step(0.275f, 0.245f, p.y);
    const float fold = 0.085f + 0.062f * soft_step(0.32f, 0.18f, p.z);
    lines += 1.4f * bump(p.y - fold, 0.008f) * soft_step(0.165f, 0.20f, p.z) * soft_step(0.335f, 0.31f, p.z);
    tint({0.66f, 0.52f, 0.48f}, 0.75f * old * lines);
  }
  // Lips.
  if (is_front) {
    const float across = p.y / 0.108f;
    const float top = 0.199f + (0.0265f + 0.008f * l.lips) * (1.0f - across * across) *
                                   (1.0f - 0.22f * bump(p.y, 0.018f)),
                bottom = 0.199f - (0.0325f + 0.010f * l.lips) * (1.0f - across * across * across * across);
    const float inside =
        soft_step(-0.004f, 0.005f, std::min(top - p.z, p.z - bottom)) * soft_step(1.03f, 0.96f, across);
    const vec3 lip = l.has_make_up ? vec3(0.95f, 0.34f, 0.36f) : vec3(0.90f, 0.56f, 0.54f);
    tint(lip, inside * (l.has_make_up ? 0.95f : l.is_female ? 0.85f : 0.6f));
    tint(vec3(0.85f), inside * soft_step(0.20f, 0.212f, p.z));
    tint({0.22f, 0.11f, 0.10f},
         bump(p.z - 0.1985f - 0.004f * across * across, 0.0042f) * soft_step(1.08f, 0.9f, across));
  }
  // Beard: a shadow on the shaven.
  if (!l.is_female && l.age > 16.0f) {
    const float jaw = soft_step(0.30f, 0.24f, p.z + 0.10f * soft_step(0.20f, 0.05f, p.x)) *
                      soft_step(-0.12f, -0.04f, p.z) * soft_step(-0.03f, 0.06f, p.x);
    const float side = soft_step(0.40f, 0.30f, p.z) * soft_step(0.20f, 0.235f, p.y) *
                       soft_step(-0.02f, 0.04f, p.x) * soft_step(0.17f, 0.11f, p.x);
    const float lip = bump(p.z - 0.252f, 0.02f) * soft_step(0.13f, 0.10f, p.y) * soft_step(0.20f, 0.3f, p.x);
    const float mouth = soft_step(0.125f, 0.095f, p.y) * bump(p.z - 0.198f, 0.03f);
    const float grown = glm::clamp(std::max({jaw, side, lip}) - mouth, 0.0f, 1.0f);
    tint({0.80f, 0.80f, 0.84f}, 0.6f * grown);
    if (l.beard * grown > 0.0f)
      cover(l.hair * 1.3f, l.beard * grown * (0.75f + 0.25f * smooth_noise(q * 150.0f)));
  }
  // Brows.
  if (is_front) {
    const float t = (p.y - 0.135f) / 0.095f,
                middle = 0.598f + 0.018f * (1.0f - (t - 0.25f) * (t - 0.25f)) - 0.012f * std::max(0.0f, t);
    const float half = (l.is_female ? 0.0085f : 0.0135f) * (1.0f - 0.55f * soft_step(0.0f, 1.0f, t));
    const float grown = soft_step(half + 0.008f, half - 0.003f, std::abs(p.z - middle)) *
                        soft_step(1.05f, 0.85f, std::abs(t));
    if (grown > 0.0f)
      cover(
          l.hair * 0.9f,
          0.9f * grown * (0.72f + 0.28f * smooth_noise(vec3(q.y * 150.0f + 60.0f * q.z, q.z * 60.0f, 3.0f))));
  }
  // Eyes.
  if (is_front) {
    const float y0 = 0.146f, z0 = 0.508f, half = 0.0640f + 0.005f * l.eyes;
    const float t = (p.y - y0) / half, arch = std::max(0.0f, 1.0f - t * t);
    const float tilt = 0.006f * t;
    const float upper = z0 + tilt + (0.0255f + 0.004f * l.eyes) * std::pow(arch, 0.75f),
                lower = z0 + tilt - 0.0175f * std::pow(arch, 0.9f);
    const float soft = 0.0022f;
    const float open =
        soft_step(-soft, soft, std::min(upper - p.z, p.z - lower)) * (std::abs(t) < 1.0f ? 1.0f : 0.0f);
    // Crease of the lid, and make-up on it.
    tint({0.60f, 0.46f, 0.43f},
         0.8f * bump(p.z - upper - 0.0165f, 0.0045f) * soft_step(1.15f, 0.8f, std::abs(t)));
    if (l.has_make_up)
      tint({0.70f, 0.58f, 0.62f}, 0.6f * soft_step(0.022f, 0.004f, p.z - upper) *
                                      soft_step(-0.004f, 0.0f, p.z - upper) *
                                      soft_step(1.1f, 0.8f, std::abs(t)));
    // Lashes.
    const float lash = l.is_female ? 0.0062f : 0.0042f;
    if (std::abs(t) < 1.12f) {
      cover({0.012f, 0.009f, 0.008f}, (l.is_female ? 0.95f : 0.8f) * bump(p.z - upper - 0.25f * lash, lash));
      tint({0.55f, 0.42f, 0.40f}, 0.75f * bump(p.z - lower + 0.001f, 0.0035f));
    }
    if (open > 0.0f) {
      const float r = glm::length(glm::vec2(p.y - y0 + 0.002f, p.z - z0 - 0.004f));
      vec3 eye(0.50f, 0.465f, 0.44f);
      eye = glm::mix(eye, vec3(0.50f, 0.30f, 0.27f), 0.55f * soft_step(0.55f, 1.0f, std::abs(t)));
      const float streaks = 1.0f + 0.25f * std::sin(26.0f * std::atan2(p.z - z0, p.y - y0));
      eye = glm::mix(eye, l.iris * 1.5f * streaks, soft_step(0.0275f, 0.0250f, r));
      eye = glm::mix(eye, l.iris * 0.25f, bump(r - 0.0262f, 0.0028f));
      eye = glm::mix(eye, vec3(0.004f), soft_step(0.0125f, 0.0105f, r));
      eye *= 1.0f - 0.68f * soft_step(0.016f, 0.0f, upper - p.z);
      const float glint = glm::length(glm::vec2(q.y - std::copysign(y0, q.y) - 0.008f, p.z - z0 - 0.0135f));
      eye = glm::mix(eye, vec3(0.95f), soft_step(0.0062f, 0.0042f, glint));
      colour = glm::mix(colour, eye, open);
    }
  }
  cover(l.hair, 0.85f * scalp);
  return glm::clamp(colour, 0.0f, 1.0f);
}

}  // namespace

Image8 face_texture(const HeadField& field, const HeadLook& look, int size) {
  // Positions on a coarser grid, between which those of texels are linear.
  constexpr int columns = 76, rows = 84;
  std::vector<vec3> places;
  const auto distance = [&](vec3 p) { return field.face(p); };
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c)
      places.push_back(cast(ray_of(float(c) / float(columns), float(r) / float(rows)), distance, face_reach));
  Image8 image(size, size, 4, 255);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const glm::vec2 at = glm::vec2((float(x) + 0.5f) / float(size) * float(columns),
                                     (1.0f - (float(y) + 0.5f) / float(size)) * float(rows));
      const glm::ivec2 cell = glm::min(glm::ivec2(at), glm::ivec2(columns - 1, rows - 1));
      const glm::vec2 f = at - glm::vec2(cell);
      const auto place = [&](int i, int j) {
        return places[std::size_t((cell.y + j) * (columns + 1) + cell.x + i)];
      };
      const vec3 p =
          glm::mix(glm::mix(place(0, 0), place(1, 0), f.x), glm::mix(place(0, 1), place(1, 1), f.x), f.y);
      const vec3 srgb = srgb_from_linear(face_colour(look, p, field));
      for (int i = 0; i < 3; ++i) image.at(x, y)[i] = std::uint8_t(255.0f * srgb[i] + 0.5f);
    }
  return image;
}

namespace {

/// The height of strands that run along v, about 0; repeats in u.
float strand_height(float u, float v) {
  float sum = 0.0f;
  for (const int count : {19, 43, 97}) {
    const float bend = 0.25f * std::sin(2.0f * pi * v + float(count));
    sum += std::sin(2.0f * pi * (float(count) * u + bend) + 1.5f * std::sin(6.0f * pi * u + float(count)));
  }
  return sum / 3.0f;
}

}  // namespace

Image8 strand_texture(int size) {
  Image8 image(size, size, 4, 255);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const float h = strand_height(float(x) / float(size), float(y) / float(size));
      const float value = srgb_from_linear(glm::clamp(0.70f + 0.28f * h, 0.0f, 1.0f));
      for (int i = 0; i < 3; ++i) image.at(x, y)[i] = std::uint8_t(255.0f * value + 0.5f);
    }
  return image;
}

Image8 strand_normals(int size) {
  Image8 image(size, size, 4, 255);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const float u = float(x) / float(size), v = float(y) / float(size), step = 1.0f / float(size);
      const float slope = strand_height(u + step, v) - strand_height(u - step, v);
      const vec3 normal = glm::normalize(vec3(-0.45f * slope, 0.0f, 1.0f));
      for (int i = 0; i < 3; ++i) image.at(x, y)[i] = std::uint8_t(255.0f * (0.5f + 0.5f * normal[i]));
    }
  return image;
}

}  // namespace parvis::people
