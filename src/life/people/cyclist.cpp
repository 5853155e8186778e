#include "life/people/cyclist.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/colour.h"
#include "base/random.h"
#include "life/people/person_model.h"
#include "synthesis/round_mesh.h"

namespace parvis::people {
namespace {

using glm::vec3;

constexpr double metres_per_turn = 5.2;  // of the cranks: 58 turns per minute at 5 m/s
constexpr float wheel_m = 0.34f, tyre_m = 0.019f, axles_m = 1.06f, rear_axle_before_cranks_m = -0.44f;
constexpr float hands_forward = 0.03f;  // of the palms before the grips' middle

/// Parts of the bicycle, added to a model behind those of the rider.
class BicycleBuilder {
 public:
  BicycleBuilder(scene::Model& model, std::uint64_t number) : model_(model) {
    Random random(number, 93);
    const std::array<vec3, 5> paints{linear_from_srgb8(30, 34, 40), linear_from_srgb8(40, 84, 120),
                                     linear_from_srgb8(150, 40, 36), linear_from_srgb8(60, 96, 70),
                                     linear_from_srgb8(200, 196, 186)};
    paint_ = add("lacquer", paints[std::size_t(random.index(5))], 0.3f, 0.0f);
    metal_ = add("metal", vec3(0.62f), 0.3f, 1.0f);
    rubber_ = add("rubber", vec3(0.025f), 0.75f, 0.0f);
  }
  int paint() const { return paint_; }
  int metal() const { return metal_; }
  int rubber() const { return rubber_; }

  int node(const char* name, vec3 place) {
    scene::ModelNode made;
    made.name = name, made.parent = 0, made.translation = place;
    model_.nodes.push_back(made);
    return int(model_.nodes.size()) - 1;
  }
  void bar(const std::vector<vec3>& points, float radius_m, int material, int node = 0) {
    std::vector<synthesis::TubeRing> rings;
    for (const vec3 p : points) rings.push_back({p, radius_m});
    scene::Part part;
    part.object = "bicycle", part.mesh = synthesis::tube(rings, 8), part.material = material,
    part.node = node;
    model_.parts.push_back(std::move(part));
  }
  void ring(float radius_m, float thick_m, int material, int node) {
    std::vector<vec3> points;
    constexpr int parts = 32;
    for (int i = 0; i <= parts; ++i) {
      const float angle = 2.0f * pi * float(i) / float(parts);
      points.push_back(radius_m * vec3(std::cos(angle), 0.0f, std::sin(angle)));
    }
    bar(points, thick_m, material, node);
  }
  void wheel(const char* name, vec3 axle) {
    const int at = node(name, axle);
    ring(wheel_m - tyre_m, tyre_m, rubber_, at), ring(wheel_m - 2.4f * tyre_m, 0.008f, metal_, at);
    bar({{0, -0.05f, 0}, {0, 0.05f, 0}}, 0.02f, metal_, at);
    for (int s = 0; s < 14; ++s) {
      const float angle = 2.0f * pi * float(s) / 14.0f;
      const vec3 out(std::cos(angle), 0.0f, std::sin(angle));
      bar({vec3(0, s % 2 == 0 ? 0.03f : -0.03f, 0) + 0.018f * out, (wheel_m - 2.4f * tyre_m) * out}, 0.0016f,
          metal_, at);
    }
  }

 private:
  int add(const char* name, vec3 colour, float roughness, float metallic) {
    scene::Material material;
    material.name = name, material.base_colour = colour, material.roughness = roughness,
    material.metallic = metallic;
    model_.materials.push_back(material);
    return int(model_.materials.size()) - 1;
  }

  scene::Model& model_;
  int paint_ = 0, metal_ = 0, rubber_ = 0;
};

Someone rider_of(std::uint64_t number) {
  Random random(number, 94);
  Someone who = someone(number, random.chance(0.5f) ? Sex::male : Sex::female, random.uniform(18.0f, 62.0f));
  // Skirts and tails of coats hang as those of people who stand.
  if (who.outfit.top == Top::coat) who.outfit.top = Top::jacket;
  if (who.outfit.bottom == Bottom::skirt || who.outfit.bottom == Bottom::dress)
    who.outfit.bottom = Bottom::jeans;
  if (who.outfit.bag == Bag::shoulder_bag) who.outfit.bag = Bag::none;
  return who;
}

/// Moves the places of a bicycle so that the middle between its axles is at the origin.
BicyclePlaces about_middle(BicyclePlaces places) {
  const vec3 back(rear_axle_before_cranks_m + 0.5f * axles_m, 0.0f, 0.0f);
  places.saddle -= back, places.cranks -= back;
  return places;
}

}  // namespace

Cyclist::Cyclist(std::uint64_t number)
    : body_(shape_of(rider_of(number).person)), places_(about_middle(bicycle_for(body_))) {
  const Someone who = rider_of(number);
  const PersonLevels levels = make_levels(who, colours_of(who, number));
  scene::Model model = *levels.models[std::size_t(Detail::middle)];
  model.name = "cyclist";
  BicycleBuilder bicycle(model, number);
  const std::vector<glm::mat4> pose = pose_of(body_.skeleton(), on_bicycle(body_, places_, 0.0f));
  const auto palm = [&](int hand) {
    return 0.4f * vec3(pose[std::size_t(hand) + 1][3]) + 0.6f * vec3(pose[std::size_t(hand) + 2][3]);
  };
  const vec3 left = palm(left_hand), right = palm(right_hand), cranks = places_.cranks,
             saddle = places_.saddle;
  const vec3 rear(cranks.x + rear_axle_before_cranks_m, 0.0f, wheel_m), front = rear + vec3(axles_m, 0, 0);
  const vec3 grips(0.5f * (left.x + right.x) - hands_forward, 0.0f, 0.5f * (left.z + right.z) - 0.02f);
  // The head tube: over the front axle, at an angle, as high as the stem needs.
  const vec3 head_low = front + vec3(-0.10f, 0.0f, 0.36f), head_high = head_low + vec3(-0.06f, 0.0f, 0.16f);
  const vec3 seat = saddle - vec3(0.0f, 0.0f, 0.05f), seat_lug = glm::mix(cranks, seat, 0.72f);
  const int paint = bicycle.paint(), metal = bicycle.metal(), rubber = bicycle.rubber();
  bicycle.bar({cranks, seat_lug}, 0.017f, paint), bicycle.bar({seat_lug, seat}, 0.013f, metal);
  bicycle.bar({cranks, head_low}, 0.020f, paint), bicycle.bar({seat_lug, head_high}, 0.016f, paint);
  bicycle.bar({head_low, head_high}, 0.020f, paint);
  for (const float side : {1.0f, -1.0f}) {
    const vec3 out(0.0f, side * 0.055f, 0.0f);
    bicycle.bar({cranks + 0.4f * out, rear + out}, 0.010f, paint);
    bicycle.bar({seat_lug + 0.3f * out, rear + out}, 0.008f, paint);
    bicycle.bar({head_low + 0.6f * out, head_low + out - vec3(-0.01f, 0, 0.05f), front + out}, 0.012f, paint);
  }
  bicycle.bar({head_high, {head_high.x + 0.01f, 0.0f, grips.z - 0.01f}}, 0.013f, metal);
  bicycle.bar({{head_high.x + 0.01f, 0.0f, grips.z - 0.01f}, {grips.x + 0.04f, 0.0f, grips.z}}, 0.013f,
              metal);
  const float half = 0.5f * std::abs(left.y - right.y);
  bicycle.bar({{grips.x, -half - 0.04f, grips.z},
               {grips.x + 0.04f, -0.06f, grips.z},
               {grips.x + 0.04f, 0.06f, grips.z},
               {grips.x, half + 0.04f, grips.z}},
              0.011f, metal);
  for (const float side : {1.0f, -1.0f})
    bicycle.bar(
        {{grips.x + 0.003f, side * (half - 0.06f), grips.z}, {grips.x, side * (half + 0.05f), grips.z}},
        0.016f, rubber);
  bicycle.bar({saddle + vec3(-0.13f, 0, -0.035f), saddle + vec3(-0.05f, 0, -0.03f)}, 0.065f, rubber);
  bicycle.bar({saddle + vec3(-0.05f, 0, -0.035f), saddle + vec3(0.14f, 0, -0.03f)}, 0.03f, rubber);
  bicycle.wheel("front wheel", front), bicycle.wheel("back wheel", rear);
  cranks_ = bicycle.node("cranks", cranks);
  bicycle.ring(0.095f, 0.006f, metal, cranks_);
  for (const float side : {1.0f, -1.0f}) {
    const float y = side * 0.075f, x = side * places_.crank_m;  // the left one is in front
    bicycle.bar({{0, y, 0}, {x, y, 0}}, 0.010f, metal, cranks_);
    bicycle.bar({{x, y, 0}, {x, side * 0.155f, 0}}, 0.014f, rubber, cranks_);
  }
  bicycle.bar({{0, -0.08f, 0}, {0, 0.08f, 0}}, 0.016f, metal, cranks_);
  model_ = std::make_shared<const scene::Model>(std::move(model));
}

void Cyclist::ride(double travelled_m, std::vector<glm::mat4>& pose, std::vector<Mesh>& deformed) const {
  const double turns = travelled_m / metres_per_turn;
  const auto angle = float(2.0 * double(pi) * (turns - std::floor(turns)));
  const std::vector<glm::mat4> bones = pose_of(body_.skeleton(), on_bicycle(body_, places_, angle));
  std::ranges::copy(bones, pose.begin());
  pose[std::size_t(cranks_)] =
      glm::rotate(glm::translate(glm::mat4(1.0f), places_.cranks), angle, vec3(0.0f, 1.0f, 0.0f));
  for (std::size_t p = 0; p < model_->parts.size(); ++p)
    if (const scene::Part& part = model_->parts[p]; part.deformation)
      scene::deform(*part.deformation, {}, bones, part.node, deformed[p]);
}

}  // namespace parvis::people
