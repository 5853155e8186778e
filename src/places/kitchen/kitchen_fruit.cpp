#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "places/kitchen/kitchen_materials.h"
#include "places/kitchen/kitchen_room.h"
#include "places/kitchen/kitchen_things.h"
#include "synthesis/round_mesh.h"

namespace parvis::kitchen {
namespace {

using synthesis::Outline, synthesis::smooth, synthesis::turned, synthesis::tube;

using enum KitchenMaterial;

constexpr int fruit_sides = 32, fruit_parts = 5;

/// A fruit of this outline (from the foot up) at a place, its axis tilted.
void add_round(scene::Model& model, const char* name, const Outline& outline, KitchenMaterial skin,
               glm::vec3 at, float tilt, float heading) {
  const glm::mat4 world =
      glm::rotate(glm::rotate(glm::translate(glm::mat4(1.0f), at), heading, {0, 0, 1}), tilt, {1, 0, 0});
  Mesh mesh;
  append(mesh, turned(smooth(outline, fruit_parts), fruit_sides), world);
  add_part(model, name, std::move(mesh), skin);
  if (skin != apple && skin != pear) return;
  const float top = outline.back().y;
  Mesh stem;
  append(stem,
         tube({{{0, 0, top - 0.004f}, 0.0016f},
               {{0.002f, 0, top + 0.008f}, 0.0014f},
               {{0.006f, 0, top + 0.017f}, 0.002f}},
              8),
         world);
  add_part(model, "stalk", std::move(stem), stalk);
}

Outline ball(float radius, float squeeze) {
  Outline outline;
  for (int i = 0; i <= 6; ++i) {
    const float polar = 3.14159265f * float(i) / 6.0f;
    outline.emplace_back(radius * std::sin(polar), -squeeze * radius * std::cos(polar));
  }
  return outline;
}

const Outline apple_outline{{0.0f, -0.026f}, {0.012f, -0.033f}, {0.028f, -0.026f}, {0.039f, 0.0f},
                            {0.036f, 0.02f}, {0.02f, 0.033f},   {0.008f, 0.029f},  {0.0f, 0.022f}};
const Outline pear_outline{{0.0f, -0.038f}, {0.018f, -0.038f}, {0.034f, -0.018f}, {0.033f, 0.006f},
                           {0.022f, 0.03f}, {0.016f, 0.048f},  {0.01f, 0.058f},   {0.0f, 0.061f}};
const Outline lemon_outline{{0.0f, -0.046f}, {0.006f, -0.042f}, {0.017f, -0.03f}, {0.027f, 0.0f},
                            {0.02f, 0.027f}, {0.008f, 0.038f},  {0.0f, 0.042f}};

void add_banana(scene::Model& model, glm::vec3 foot, float heading, float lean) {
  std::vector<synthesis::TubeRing> rings;
  constexpr int count = 16;
  constexpr float curve_radius_m = 0.11f;
  for (int i = 0; i <= count; ++i) {
    const float fraction = float(i) / float(count), angle = 1.7f * (fraction - 0.5f);
    const float body = std::pow(std::sin(3.14159265f * (0.06f + 0.88f * fraction)), 0.45f);
    rings.push_back(
        {{curve_radius_m * std::sin(angle), 0.0f, curve_radius_m * (1.0f - std::cos(angle))}, 0.017f * body});
  }
  Mesh mesh;
  append(
      mesh, tube(rings, 14),
      glm::rotate(glm::rotate(glm::translate(glm::mat4(1.0f), foot), heading, {0, 0, 1}), lean, {1, 0, 0}));
  add_part(model, "banana", std::move(mesh), banana);
}

}  // namespace

void add_fruit(scene::Model& model) {
  const glm::vec3 foot(0.2f, -0.4f, worktop_height_m);
  const Outline dish{{0.045f, 0.0f},   {0.05f, 0.012f}, {0.09f, 0.03f},  {0.125f, 0.06f}, {0.132f, 0.066f},
                     {0.124f, 0.064f}, {0.09f, 0.038f}, {0.05f, 0.022f}, {0.0f, 0.018f}};
  Mesh bowl;
  append(bowl, turned(smooth(dish, fruit_parts), 48), glm::translate(glm::mat4(1.0f), foot));
  add_part(model, "fruit bowl", std::move(bowl), blue);
  add_shade(model, foot, 0.13f);
  const auto at = [&](float x, float y, float z) { return foot + glm::vec3(x, y, z); };
  add_round(model, "orange", ball(0.038f, 0.96f), orange, at(-0.055f, -0.03f, 0.068f), 0.4f, 0.3f);
  add_round(model, "orange", ball(0.037f, 0.96f), orange, at(0.03f, -0.058f, 0.067f), 2.1f, 1.2f);
  add_round(model, "orange", ball(0.036f, 0.96f), orange, at(-0.005f, 0.005f, 0.112f), 1.0f, 0.2f);
  add_round(model, "apple", apple_outline, apple, at(0.062f, 0.01f, 0.072f), 0.3f, 2.0f);
  add_round(model, "apple", apple_outline, apple, at(-0.035f, 0.055f, 0.072f), -0.35f, 0.7f);
  add_round(model, "pear", pear_outline, pear, at(0.028f, 0.066f, 0.078f), -0.5f, -0.4f);
  add_round(model, "lemon", lemon_outline, lemon, at(0.066f, -0.004f, 0.124f), 1.4f, 0.6f);
  for (int i = 0; i < 3; ++i)
    add_banana(model, at(-0.02f + 0.012f * float(i), -0.035f + 0.026f * float(i), 0.105f + 0.012f * float(i)),
               2.5f + 0.22f * float(i), 0.25f);
  // Some lie on the worktop.
  add_round(model, "lemon", lemon_outline, lemon, {-0.16f, -0.5f, worktop_height_m + 0.027f}, 1.5708f, 0.8f);
  add_shade(model, {-0.16f, -0.5f, worktop_height_m}, 0.03f);
  add_round(model, "apple", apple_outline, apple, {0.4f, -0.5f, worktop_height_m + 0.033f}, 0.0f, 1.0f);
  add_shade(model, {0.4f, -0.5f, worktop_height_m}, 0.035f);
}

}  // namespace parvis::kitchen
