#include "places/paper_city/walker.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace parvis::city {
namespace {

constexpr int limb_sides = 10;
constexpr int keys = 16;  // of the animation, over one double step
constexpr float hip_m = 0.92f, knee_m = 0.46f, shoulder_m = 1.42f;
constexpr float thigh_swing = 0.42f, arm_swing = 0.5f;  // radians to either side
constexpr float knee_bend = 0.75f;
/// A double step is as long as two legs spread; so long it takes.
const float step_s = 4.0f * hip_m * std::sin(thigh_swing) / walking_speed_m_s;

enum Cloth : int { jacket, trousers, skin, hair, shoes };

/// A section of a limb: half widths forward and sideways at a height, shifted forward.
struct Ring {
  float z, forward, sideways, shift = 0.0f;
};

/// A closed skin through rings from the lowest to the highest.
Mesh limb(std::initializer_list<Ring> rings) {
  Mesh mesh;
  const auto add = [&](const Ring& ring, float angle, float size) {
    mesh.positions.emplace_back(ring.shift + size * ring.forward * std::cos(angle),
                                size * ring.sideways * std::sin(angle), ring.z);
    mesh.uvs.emplace_back(0.0f);
  };
  for (const Ring& ring : rings)
    for (int i = 0; i < limb_sides; ++i) add(ring, 2.0f * glm::pi<float>() * float(i) / limb_sides, 1.0f);
  const auto bottom = std::uint32_t(mesh.positions.size()), top = bottom + 1;
  add(*rings.begin(), 0.0f, 0.0f);
  add(*(rings.end() - 1), 0.0f, 0.0f);
  const auto last = std::uint32_t((rings.size() - 1) * limb_sides);
  for (std::uint32_t i = 0; i < limb_sides; ++i) {
    const std::uint32_t next = (i + 1) % limb_sides;
    for (std::uint32_t ring = 0; ring < last; ring += limb_sides)
      mesh.indices.insert(mesh.indices.end(), {ring + i, ring + next, ring + limb_sides + next, ring + i,
                                               ring + limb_sides + next, ring + limb_sides + i});
    mesh.indices.insert(mesh.indices.end(), {bottom, next, i, top, last + i, last + next});
  }
  fill_normals(mesh);
  return mesh;
}

class Figure {
 public:
  explicit Figure(const WalkerClothes& clothes) {
    model_.name = std::string("walker_") + clothes.name;
    for (const auto& [name, colour] : {std::pair{"jacket", clothes.jacket},
                                       {"trousers", clothes.trousers},
                                       {"skin", clothes.skin},
                                       {"hair", clothes.hair},
                                       {"shoes", glm::vec3(0.03f)}}) {
      scene::Material material;
      material.name = name;
      material.base_colour = colour;
      material.roughness = 0.85f;
      model_.materials.push_back(material);
    }
    model_.nodes.front().name = "walker";
    model_.animations.push_back({"walk", {}, {}, step_s});
  }

  int node(const char* name, int parent, glm::vec3 at) {
    model_.nodes.push_back({name, parent, at});
    return int(model_.nodes.size()) - 1;
  }
  void part(const char* name, int node, Cloth cloth, std::initializer_list<Ring> rings) {
    model_.parts.push_back({name, limb(rings), int(cloth), node});
  }
  /// Turns a node about its sideways axis; `angle(phase)` for phases 0 to 2 pi, positive: its foot backward.
  template <class Angle>
  void swing(int node, const Angle& angle) {
    channel(node, scene::AnimationChannel::Property::rotation, [&](float phase) {
      const glm::quat turn = glm::angleAxis(angle(phase), glm::vec3(0, 1, 0));
      return glm::vec4(turn.x, turn.y, turn.z, turn.w);
    });
  }
  template <class Value>
  void channel(int node, scene::AnimationChannel::Property property, const Value& value) {
    scene::AnimationChannel made;
    made.node = node;
    made.property = property;
    for (int key = 0; key <= keys; ++key) {
      made.times_s.push_back(step_s * float(key) / keys);
      made.values.push_back(value(2.0f * glm::pi<float>() * float(key) / keys));
    }
    model_.animations.front().channels.push_back(std::move(made));
  }
  scene::Model take() { return std::move(model_); }

 private:
  scene::Model model_;
};

/// `phase_ahead`: half a turn apart for the two legs.
void add_leg(Figure& figure, int body, float side_m, float phase_ahead) {
  const int thigh = figure.node("thigh", body, {0, side_m, hip_m});
  figure.part(
      "thigh", thigh, trousers,
      {{-0.48f, 0.060f, 0.058f}, {-0.25f, 0.078f, 0.075f}, {0.0f, 0.095f, 0.09f}, {0.06f, 0.07f, 0.07f}});
  figure.swing(thigh, [=](float phase) { return -thigh_swing * std::sin(phase + phase_ahead); });
  const int shin = figure.node("shin", thigh, {0, 0, knee_m - hip_m});
  figure.part("shin", shin, trousers,
              {{-0.40f, 0.045f, 0.042f}, {-0.2f, 0.062f, 0.058f, -0.01f}, {0.02f, 0.060f, 0.057f}});
  const int foot = figure.node("foot", shin, {0, 0, -0.40f});
  figure.part(
      "shoe", foot, shoes,
      {{-0.06f, 0.130f, 0.048f, 0.055f}, {-0.01f, 0.120f, 0.045f, 0.050f}, {0.03f, 0.055f, 0.042f, 0.0f}});
  // Soles stay about level.
  figure.swing(foot, [=](float phase) {
    return 0.8f * (thigh_swing * std::sin(phase + phase_ahead) -
                   knee_bend * std::max(0.0f, std::cos(phase + phase_ahead)));
  });
  // The knee gives way while the leg comes forward.
  figure.swing(shin, [=](float phase) { return knee_bend * std::max(0.0f, std::cos(phase + phase_ahead)); });
}

void add_arm(Figure& figure, int body, float side_m, float phase_ahead) {
  const int upper = figure.node("upper arm", body, {0, side_m, shoulder_m});
  figure.part("sleeve", upper, jacket,
              {{-0.30f, 0.042f, 0.040f}, {-0.1f, 0.052f, 0.048f}, {0.03f, 0.055f, 0.05f}});
  figure.swing(upper, [=](float phase) { return -arm_swing * std::sin(phase + phase_ahead); });
  const int lower = figure.node("forearm", upper, {0, 0, -0.29f});
  figure.part("forearm", lower, jacket,
              {{-0.24f, 0.033f, 0.030f}, {-0.1f, 0.042f, 0.038f}, {0.02f, 0.042f, 0.04f}});
  figure.part("hand", lower, skin,
              {{-0.40f, 0.020f, 0.012f, 0.01f}, {-0.32f, 0.042f, 0.022f, 0.01f}, {-0.24f, 0.028f, 0.024f}});
  figure.swing(lower, [=](float phase) { return -0.25f - 0.2f * std::sin(phase + phase_ahead); });
}

}  // namespace

scene::Model make_walker(const WalkerClothes& clothes) {
  Figure figure(clothes);
  const int body = figure.node("body", 0, glm::vec3(0.0f));
  // Spread legs reach less far down: the body sinks, so that the lower foot stays on the ground.
  figure.channel(body, scene::AnimationChannel::Property::translation, [](float phase) {
    return glm::vec4(0, 0, -hip_m * (1.0f - std::cos(thigh_swing * std::sin(phase))), 0);
  });
  figure.part("trunk", body, jacket,
              {{0.84f, 0.105f, 0.165f},
               {0.98f, 0.110f, 0.165f},
               {1.15f, 0.115f, 0.165f},
               {1.32f, 0.125f, 0.195f},
               {1.43f, 0.095f, 0.190f},
               {1.49f, 0.060f, 0.080f}});
  figure.part("neck", body, skin, {{1.45f, 0.052f, 0.052f}, {1.56f, 0.050f, 0.050f}});
  figure.part("head", body, skin,
              {{1.52f, 0.045f, 0.040f, 0.025f},
               {1.56f, 0.080f, 0.062f, 0.015f},
               {1.63f, 0.095f, 0.075f, 0.01f},
               {1.70f, 0.085f, 0.070f},
               {1.735f, 0.04f, 0.035f}});
  figure.part("hair", body, hair,
              {{1.60f, 0.062f, 0.078f, -0.045f},
               {1.67f, 0.092f, 0.080f, -0.018f},
               {1.72f, 0.078f, 0.070f, -0.01f},
               {1.75f, 0.035f, 0.035f, -0.01f}});
  for (const float side : {1.0f, -1.0f}) {
    const float phase = side > 0.0f ? 0.0f : glm::pi<float>();
    add_leg(figure, body, 0.09f * side, phase);
    add_arm(figure, body, 0.235f * side, phase + glm::pi<float>());
  }
  return figure.take();
}

std::vector<scene::Model> city_walkers() {
  constexpr std::array<WalkerClothes, 3> clothes{
      {{"blue", {0.05f, 0.10f, 0.28f}, {0.05f, 0.05f, 0.06f}, {0.05f, 0.03f, 0.02f}, {0.55f, 0.33f, 0.24f}},
       {"red", {0.45f, 0.05f, 0.05f}, {0.06f, 0.08f, 0.14f}, {0.25f, 0.15f, 0.06f}, {0.60f, 0.38f, 0.28f}},
       {"sand", {0.45f, 0.36f, 0.22f}, {0.14f, 0.11f, 0.08f}, {0.02f, 0.02f, 0.02f}, {0.22f, 0.12f, 0.07f}}}};
  std::vector<scene::Model> walkers;
  walkers.reserve(clothes.size());
  for (const WalkerClothes& worn : clothes) walkers.push_back(make_walker(worn));
  return walkers;
}

}  // namespace parvis::city
