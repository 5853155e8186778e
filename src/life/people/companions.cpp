#include "life/people/companions.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/colour.h"
#include "base/random.h"
#include "life/people/surface_net.h"
#include "synthesis/round_mesh.h"

namespace parvis::people {
namespace {

using glm::vec2, glm::vec3;

/// Materials of all companions, in this order.
enum CompanionSurface : std::uint8_t { fabric, frame, rubber, fur, muzzle, companion_surfaces };

scene::Material companion_material(const char* name, vec3 colour, float roughness, float metallic = 0.0f) {
  scene::Material result;
  result.name = name, result.base_colour = colour, result.roughness = roughness, result.metallic = metallic;
  return result;
}

vec3 one_of(Random& random, std::initializer_list<vec3> colours) {
  return colours.begin()[random.index(int(colours.size()))];
}

/// A model to which meshes are added by surface.
class CompanionBuilder {
 public:
  explicit CompanionBuilder(const char* name, std::uint64_t number) {
    Random random(number, 91);
    model_.name = name;
    const vec3 cloth = one_of(random, {linear_from_srgb8(38, 46, 66), linear_from_srgb8(96, 40, 46),
                                       linear_from_srgb8(72, 80, 70), linear_from_srgb8(52, 52, 56)});
    const vec3 coat = one_of(random, {linear_from_srgb8(120, 88, 56), linear_from_srgb8(44, 38, 34),
                                      linear_from_srgb8(206, 190, 164), linear_from_srgb8(150, 112, 70)});
    model_.materials = {
        companion_material("fabric", cloth, 0.85f), companion_material("frame", vec3(0.62f), 0.28f, 1.0f),
        companion_material("rubber", vec3(0.025f), 0.75f), companion_material("fur", coat, 0.95f),
        companion_material("muzzle", 0.35f * coat, 0.6f)};
    for (scene::Material& material : model_.materials) material.is_double_sided = true;
  }

  void add(Mesh mesh, CompanionSurface surface, int node = 0) {
    if (mesh.indices.empty()) return;
    scene::Part part;
    part.object = model_.materials[surface].name, part.mesh = std::move(mesh), part.material = surface;
    part.node = node;
    model_.parts.push_back(std::move(part));
  }
  void add_bar(std::vector<vec3> points, float radius_m, CompanionSurface surface = frame) {
    std::vector<synthesis::TubeRing> rings;
    for (const vec3 p : points) rings.push_back({p, radius_m});
    add(synthesis::tube(rings, 8), surface);
  }
  /// A wheel about an axle along y: tyre, rim and spokes, on a node of its own.
  void add_wheel(vec3 middle, float radius_m, float tyre_m, int spokes) {
    const int node = int(model_.nodes.size());
    scene::ModelNode wheel;
    wheel.name = "wheel " + std::to_string(node), wheel.parent = 0, wheel.translation = middle;
    model_.nodes.push_back(wheel);
    add(ring(radius_m - tyre_m, tyre_m, 28), rubber, node);
    add(ring(radius_m - 2.2f * tyre_m, 0.4f * tyre_m, 24), frame, node);
    add(synthesis::tube({{{0, -0.025f, 0}, 0.018f}, {{0, 0.025f, 0}, 0.018f}}, 8), frame, node);
    for (int s = 0; s < spokes; ++s) {
      const float angle = 2.0f * pi * float(s) / float(spokes);
      const vec3 out(std::cos(angle), 0.0f, std::sin(angle));
      add(synthesis::tube({{0.015f * out, 0.003f}, {(radius_m - 2.2f * tyre_m) * out, 0.003f}}, 5), frame,
          node);
    }
  }
  std::shared_ptr<const scene::Model> finish() {
    return std::make_shared<const scene::Model>(std::move(model_));
  }

  /// A ring about the y axis.
  static Mesh ring(float radius_m, float thick_m, int parts) {
    std::vector<synthesis::TubeRing> rings;
    for (int i = 0; i <= parts; ++i) {
      const float angle = 2.0f * pi * float(i) / float(parts);
      rings.push_back({radius_m * vec3(std::cos(angle), 0.0f, std::sin(angle)), thick_m});
    }
    return synthesis::tube(rings, 8);
  }

 private:
  scene::Model model_;
};

/// The place between both palms in a posture, in the person's frame.
vec3 palms(const BodyField& body, const Posture& posture, int side) {
  const std::vector<glm::mat4> pose = pose_of(body.skeleton(), posture);
  const std::size_t hand = side == 0 ? left_hand : right_hand, fingers = hand + 1;
  return 0.5f * (vec3(pose[hand + 1][3]) + vec3(pose[fingers + 1][3]));
}

Posture standing_at_handle(const BodyField& body) {
  Posture posture = on_the_spot(body, Activity::stand, 0.0f, 0.0f);
  hold_handle(body, posture);
  return posture;
}

std::shared_ptr<const scene::Model> pram(const BodyField& body, std::uint64_t number) {
  CompanionBuilder builder("pram", number);
  const Posture posture = standing_at_handle(body);
  const vec3 left = palms(body, posture, 0), right = palms(body, posture, 1);
  const float handle_x = 0.5f * (left.x + right.x), handle_z = 0.5f * (left.z + right.z) - 0.015f;
  constexpr float half_m = 0.21f, basket_half_m = 0.40f, wheel_m = 0.14f, basket_z = 0.62f, track_m = 0.26f;
  const float middle_x = handle_x + 0.30f + basket_half_m, axle = 0.34f;
  // The basket: a rounded tub, open at its top; the hood covers its end near the handle, where the child
  // lies.
  const auto tub = [=](vec3 p, float wider) {
    const vec3 q = glm::abs(p - vec3(middle_x, 0.0f, basket_z)) -
                   vec3(basket_half_m - 0.10f, half_m - 0.10f, 0.13f - 0.08f);
    return glm::length(glm::max(q, vec3(0.0f))) + std::min(std::max({q.x, q.y, q.z}), 0.0f) - 0.10f - wider;
  };
  const Field basket = [=](vec3 p) {
    return smooth_max(smooth_max(tub(p, 0.0f), -tub(p - vec3(0, 0, 0.06f), -0.032f), 0.006f),
                      p.z - basket_z - 0.11f, 0.006f);
  };
  const vec3 hood_at(middle_x - 0.15f, 0.0f, basket_z + 0.10f);
  const Field hood = [=](vec3 p) {
    const float outer = ellipsoid(p, hood_at, {0.275f, half_m + 0.010f, 0.305f}),
                inner = ellipsoid(p, hood_at, {0.245f, half_m - 0.020f, 0.275f});
    const float cut = glm::dot(p - hood_at - vec3(0.06f, 0, 0), glm::normalize(vec3(1.0f, 0.0f, -0.35f)));
    return smooth_max(smooth_max(outer, -inner, 0.004f), std::max(cut, hood_at.z - 0.02f - p.z), 0.004f);
  };
  const vec3 low(middle_x - 0.5f, -0.3f, basket_z - 0.2f), high(middle_x + 0.5f, 0.3f, basket_z + 0.5f);
  builder.add(surface_net(basket, low, high, 0.011f), fabric);
  builder.add(surface_net(hood, low, high, 0.011f), fabric);
  const Field blanket = [=](vec3 p) {  // and what lies below it
    return ellipsoid(p, {middle_x + 0.06f, 0.0f, basket_z - 0.01f}, {0.30f, half_m - 0.05f, 0.10f}) +
           0.004f * smooth_noise(14.0f * p);
  };
  builder.add(surface_net(blanket, low, high, 0.02f), muzzle);
  for (const float side : {1.0f, -1.0f}) {
    const float y = side * track_m;
    // From the handle to the front axle, and from the rear axle up to the basket.
    builder.add_bar({{handle_x, side * 0.20f, handle_z},
                     {handle_x + 0.10f, y, handle_z - 0.08f},
                     {middle_x - 0.1f, y, basket_z - 0.12f},
                     {middle_x + axle, y, wheel_m + 0.02f}},
                    0.012f);
    builder.add_bar({{middle_x - axle, y, wheel_m + 0.02f},
                     {middle_x - 0.05f, y, 0.42f},
                     {middle_x + 0.22f, side * half_m, basket_z - 0.06f}},
                    0.012f);
    for (const float end : {1.0f, -1.0f})
      builder.add_wheel({middle_x + end * axle, y, wheel_m}, wheel_m, 0.018f, 7);
  }
  for (const float end : {1.0f, -1.0f})
    builder.add_bar({{middle_x + end * axle, -track_m, wheel_m}, {middle_x + end * axle, track_m, wheel_m}},
                    0.010f);
  builder.add_bar({{handle_x, -0.22f, handle_z}, {handle_x, 0.22f, handle_z}}, 0.016f, rubber);
  return builder.finish();
}

std::shared_ptr<const scene::Model> wheelchair(const BodyField& body, std::uint64_t number) {
  CompanionBuilder builder("wheelchair", number);
  const BodyShape& s = body.shape();
  const float seat_z = 0.45f + footrest_m - 0.02f, half = std::max(0.21f, s.hips_half + 0.04f);
  const float back_x = -0.6f * s.hips_depth - 0.06f, knee_x = s.thigh() - 0.06f;
  const float wheel_m = 0.30f, caster_m = 0.09f, wheel_x = back_x + 0.12f;
  const auto cushion = [](vec3 low, vec3 high, float round) {
    const vec3 middle = 0.5f * (low + high), half_size = 0.5f * (high - low) - round;
    const Field field = [=](vec3 p) {
      const vec3 q = glm::abs(p - middle) - half_size;
      return glm::length(glm::max(q, vec3(0.0f))) + std::min(std::max({q.x, q.y, q.z}), 0.0f) - round;
    };
    return surface_net(field, low - 0.03f, high + 0.03f, 0.016f);
  };
  builder.add(cushion({back_x, -half, seat_z - 0.06f}, {knee_x - 0.08f, half, seat_z}, 0.025f), fabric);
  builder.add(cushion({back_x - 0.04f, -half, seat_z + 0.06f}, {back_x, half, seat_z + 0.44f}, 0.018f),
              fabric);
  for (const float side : {1.0f, -1.0f}) {
    const float y = side * (half + 0.01f), out = side * (half + 0.06f);
    builder.add_bar({{back_x - 0.16f, y, seat_z + 0.46f},
                     {back_x - 0.03f, y, seat_z + 0.45f},
                     {back_x - 0.02f, y, seat_z - 0.05f},
                     {back_x, y, 0.20f}},
                    0.012f);  // push handle and back
    builder.add_bar({{back_x - 0.17f, y, seat_z + 0.46f}, {back_x - 0.07f, y, seat_z + 0.455f}}, 0.017f,
                    rubber);
    builder.add_bar({{back_x, y, seat_z - 0.05f},
                     {knee_x - 0.06f, y, seat_z - 0.05f},
                     {knee_x + 0.02f, y, seat_z - 0.14f},
                     {knee_x + 0.08f, side * 0.12f, footrest_m + 0.01f}},
                    0.012f);
    builder.add_bar({{back_x + 0.02f, y, seat_z + 0.22f}, {back_x + 0.30f, y, seat_z + 0.22f}}, 0.018f,
                    rubber);
    builder.add_bar({{back_x + 0.30f, y, seat_z + 0.22f}, {back_x + 0.32f, y, seat_z - 0.05f}}, 0.010f);
    builder.add_bar({{back_x, y, 0.20f}, {knee_x - 0.12f, y, 0.22f}, {knee_x - 0.08f, y, seat_z - 0.05f}},
                    0.011f);
    builder.add_wheel({wheel_x, out, wheel_m}, wheel_m, 0.014f, 18);
    Mesh rim = CompanionBuilder::ring(wheel_m - 0.035f, 0.008f, 28);
    for (vec3& p : rim.positions) p += vec3(wheel_x, out + side * 0.035f, wheel_m);
    builder.add(std::move(rim), frame);  // by which the wheel is turned
    builder.add_wheel({knee_x - 0.10f, side * (half - 0.02f), caster_m}, caster_m, 0.016f, 4);
    builder.add_bar({{knee_x - 0.10f, side * (half - 0.02f), caster_m + 0.02f}, {knee_x - 0.12f, y, 0.22f}},
                    0.010f);
    Mesh plate = cushion({knee_x - 0.03f, side > 0.0f ? 0.03f : -0.17f, footrest_m - 0.02f},
                         {knee_x + 0.17f, side > 0.0f ? 0.17f : -0.03f, footrest_m}, 0.008f);
    builder.add(std::move(plate), rubber);
  }
  builder.add_bar({{wheel_x, -half - 0.06f, wheel_m}, {wheel_x, half + 0.06f, wheel_m}}, 0.012f);
  for (const float side : {1.0f, -1.0f})  // the cross below the seat
    builder.add_bar({{back_x + 0.16f, -side * half, 0.22f}, {back_x + 0.16f, side * half, seat_z - 0.06f}},
                    0.009f);
  return builder.finish();
}

std::shared_ptr<const scene::Model> dog(const BodyField& body, std::uint64_t number) {
  CompanionBuilder builder("dog", number);
  Random random(number, 92);
  const float size = random.uniform(0.75f, 1.15f);  // 1: 0.55 m at the withers
  const vec3 foot(0.25f, -0.55f, 0.0f);             // beside the right hand, a little ahead
  const bool has_hanging_ears = random.chance(0.5f);
  const auto at = [=](float x, float y, float z) { return foot + size * vec3(x, y, z); };
  const vec3 chest = at(0.16f, 0, 0.43f), loin = at(-0.22f, 0, 0.46f), withers = at(0.20f, 0, 0.50f),
             skull = at(0.36f, 0, 0.66f), nose = at(0.535f, 0, 0.615f);
  const Field coat = [=](vec3 p) {
    float d = round_cone(p, chest, loin, 0.118f * size, 0.088f * size);
    d = smooth_min(d, round_cone(p, withers, skull, 0.085f * size, 0.066f * size), 0.07f * size);
    d = smooth_min(d,
                   ellipsoid(p, skull + size * vec3(0.02f, 0, 0.005f), size * vec3(0.095f, 0.075f, 0.075f)),
                   0.03f * size);
    d = smooth_min(d,
                   round_cone(p, skull + size * vec3(0.05f, 0, -0.015f), nose, 0.05f * size, 0.030f * size),
                   0.03f * size);
    for (const float side : {1.0f, -1.0f}) {
      const vec3 ear = skull + size * vec3(-0.03f, side * 0.05f, 0.055f);
      const vec3 tip = ear + size * (has_hanging_ears ? vec3(-0.01f, side * 0.05f, -0.11f)
                                                      : vec3(-0.015f, side * 0.018f, 0.085f));
      d = smooth_min(d,
                     round_cone(p, ear, tip, 0.026f * size, has_hanging_ears ? 0.022f * size : 0.008f * size),
                     0.018f * size);
      // Fore legs are straight; hind legs go back to the hock.
      const vec3 shoulder = at(0.17f, side * 0.07f, 0.36f), wrist = at(0.165f, side * 0.075f, 0.12f),
                 paw = at(0.185f, side * 0.075f, 0.024f);
      d = smooth_min(d, round_cone(p, shoulder, wrist, 0.056f * size, 0.027f * size), 0.03f * size);
      d = smooth_min(d, round_cone(p, wrist, paw, 0.027f * size, 0.026f * size), 0.015f * size);
      d = smooth_min(d,
                     round_cone(p, paw, paw + size * vec3(0.04f, 0, -0.002f), 0.026f * size, 0.021f * size),
                     0.01f * size);
      const vec3 hip = at(-0.24f, side * 0.065f, 0.40f), stifle = at(-0.17f, side * 0.08f, 0.27f),
                 hock = at(-0.30f, side * 0.075f, 0.155f), hind = at(-0.285f, side * 0.075f, 0.024f);
      d = smooth_min(d, round_cone(p, hip, stifle, 0.075f * size, 0.052f * size), 0.03f * size);
      d = smooth_min(d, round_cone(p, stifle, hock, 0.048f * size, 0.025f * size), 0.025f * size);
      d = smooth_min(d, round_cone(p, hock, hind, 0.024f * size, 0.024f * size), 0.015f * size);
      d = smooth_min(
          d, round_cone(p, hind, hind + size * vec3(0.045f, 0, -0.002f), 0.025f * size, 0.021f * size),
          0.01f * size);
    }
    const vec3 root = at(-0.31f, 0, 0.49f), bend = at(-0.42f, 0, 0.52f), end = at(-0.49f, 0, 0.62f);
    d = smooth_min(d, round_cone(p, root, bend, 0.032f * size, 0.024f * size), 0.03f * size);
    d = smooth_min(d, round_cone(p, bend, end, 0.024f * size, 0.010f * size), 0.02f * size);
    return d + 0.0045f * size * smooth_noise(p * (26.0f / size)) +
           0.004f * size * smooth_noise(p * (11.0f / size));
  };
  const vec3 low = foot - size * vec3(0.6f, 0.2f, 0.02f), high = foot + size * vec3(0.65f, 0.2f, 0.85f);
  Mesh skin = surface_net(coat, low, high, 0.013f * size);
  for (vec3& p : skin.positions) p.z = std::max(p.z, 0.0f);
  builder.add(std::move(skin), fur);
  const auto ball = [&](vec3 centre, vec3 radii) {
    builder.add(surface_net([=](vec3 p) { return ellipsoid(p, centre, radii); }, centre - 1.6f * radii,
                            centre + 1.6f * radii, 0.3f * radii.z),
                muzzle);
  };
  ball(nose + size * vec3(0.022f, 0, 0.012f), size * vec3(0.016f, 0.018f, 0.013f));
  for (const float side : {1.0f, -1.0f})
    ball(skull + size * vec3(0.092f, side * 0.036f, 0.022f), size * vec3(0.010f, 0.009f, 0.010f));
  const vec3 collar = glm::mix(withers, skull, 0.45f);
  std::vector<vec3> band;
  for (int i = 0; i <= 20; ++i) {
    const float angle = 2.0f * pi * float(i) / 20.0f;
    band.push_back(collar +
                   size * 0.083f * vec3(-0.55f * std::sin(angle), std::cos(angle), 0.84f * std::sin(angle)));
  }
  builder.add_bar(band, 0.010f, fabric);
  const vec3 hand = palms(body, on_the_spot(body, Activity::stand, 0.0f, 0.0f), 1);
  std::vector<vec3> leash;  // hangs through a little
  for (int i = 0; i <= 12; ++i) {
    const float t = float(i) / 12.0f;
    leash.push_back(glm::mix(hand, collar + size * vec3(0, 0, 0.07f), t) -
                    vec3(0, 0, 0.28f * t * (1.0f - t)));
  }
  builder.add_bar(leash, 0.005f, fabric);
  return builder.finish();
}

}  // namespace

std::shared_ptr<const scene::Model> companion_model(Companion companion, const BodyField& body,
                                                    std::uint64_t number) {
  switch (companion) {
    case Companion::none:
      return nullptr;
    case Companion::pram:
      return pram(body, number);
    case Companion::wheelchair:
      return wheelchair(body, number);
    case Companion::dog:
      return dog(body, number);
  }
  return nullptr;
}

}  // namespace parvis::people
