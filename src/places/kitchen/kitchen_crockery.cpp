#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "places/kitchen/kitchen_materials.h"
#include "places/kitchen/kitchen_room.h"
#include "places/kitchen/kitchen_things.h"
#include "synthesis/round_mesh.h"

namespace parvis::kitchen {
namespace {

using synthesis::Outline, synthesis::smooth, synthesis::turned, synthesis::tube, synthesis::panel,
    synthesis::panelled_box;

using enum KitchenMaterial;

constexpr int crockery_sides = 36, crockery_parts = 4;

void add_turned(scene::Model& model, const char* name, const Outline& outline, KitchenMaterial material,
                glm::vec3 foot) {
  Mesh mesh;
  append(mesh, turned(smooth(outline, crockery_parts), crockery_sides),
         glm::translate(glm::mat4(1.0f), foot));
  add_part(model, name, std::move(mesh), material);
}

void add_handle(scene::Model& model, glm::vec3 foot, float radius, float low, float high, float heading,
                KitchenMaterial material) {
  std::vector<synthesis::TubeRing> rings;
  for (int i = 0; i <= 12; ++i) {
    const float angle = 3.14159265f * float(i) / 12.0f;
    const float z = 0.5f * (low + high) - 0.5f * (high - low) * std::cos(angle);
    rings.push_back({{radius - 0.004f + 0.028f * std::sin(angle), 0.0f, z}, 0.0055f});
  }
  Mesh mesh;
  append(mesh, tube(rings), glm::rotate(glm::translate(glm::mat4(1.0f), foot), heading, {0, 0, 1}));
  add_part(model, "handle", std::move(mesh), material);
}

void add_mug(scene::Model& model, glm::vec3 foot, float heading, KitchenMaterial material) {
  add_turned(model, "mug",
             {{0.0f, 0.001f},
              {0.032f, 0.0f},
              {0.038f, 0.012f},
              {0.04f, 0.05f},
              {0.041f, 0.092f},
              {0.038f, 0.093f},
              {0.037f, 0.05f},
              {0.034f, 0.012f},
              {0.0f, 0.006f}},
             material, foot);
  add_handle(model, foot, 0.04f, 0.02f, 0.075f, heading, material);
}

void add_plates(scene::Model& model, glm::vec3 foot) {
  for (int i = 0; i < 5; ++i)
    add_turned(model, "plate",
               {{0.0f, 0.0f},
                {0.06f, 0.0f},
                {0.085f, 0.008f},
                {0.115f, 0.018f},
                {0.117f, 0.021f},
                {0.112f, 0.02f},
                {0.082f, 0.011f},
                {0.06f, 0.005f},
                {0.0f, 0.005f}},
               i % 2 == 0 ? china : blue, foot + glm::vec3(0, 0, 0.0095f * float(i)));
}

void add_jar(scene::Model& model, glm::vec3 foot, float height, KitchenMaterial filling) {
  add_turned(
      model, "jar",
      {{0.0f, 0.0f}, {0.034f, 0.0f}, {0.038f, 0.008f}, {0.038f, 0.8f * height}, {0.03f, 0.92f * height}},
      filling, foot);
  add_turned(model, "lid",
             {{0.033f, 0.9f * height},
              {0.034f, 0.93f * height},
              {0.034f, height},
              {0.03f, 1.01f * height},
              {0.0f, 1.015f * height}},
             wood, foot);
}

void add_pot(scene::Model& model, glm::vec3 foot) {
  add_turned(model, "pot",
             {{0.0f, 0.0f},
              {0.04f, 0.0f},
              {0.044f, 0.01f},
              {0.055f, 0.085f},
              {0.061f, 0.09f},
              {0.061f, 0.105f},
              {0.055f, 0.105f},
              {0.05f, 0.09f},
              {0.0f, 0.088f}},
             clay, foot);
  // Wooden spoons stand in it.
  for (int i = 0; i < 4; ++i) {
    const float heading = 1.7f * float(i) + 0.4f, lean = 0.05f + 0.02f * float(i % 2);
    const glm::vec3 out(std::cos(heading), std::sin(heading), 0.0f);
    std::vector<synthesis::TubeRing> rings;
    for (int k = 0; k <= 14; ++k) {
      const float fraction = float(k) / 14.0f;
      const float radius =
          fraction < 0.72f ? 0.005f : 0.005f + 0.012f * std::sin(3.14159265f * (fraction - 0.72f) / 0.3f);
      rings.push_back(
          {foot + glm::vec3(0, 0, 0.06f + 0.26f * fraction) + (0.01f + lean * fraction * 1.4f) * out,
           radius});
    }
    add_part(model, "wooden spoon", tube(rings, 10), wood);
  }
}

void add_board(scene::Model& model) {
  // It leans against the tiles.
  Mesh board;
  append(
      board, panelled_box({-0.13f, -0.009f, 0.0f}, {0.13f, 0.009f, 0.36f}, 0.03f),
      glm::rotate(glm::translate(glm::mat4(1.0f), {-0.73f, -0.085f, worktop_height_m}), -0.19f, {1, 0, 0}));
  add_part(model, "board", std::move(board), wood);
}

void add_cloth(scene::Model& model) {
  const glm::vec3 foot(0.02f, -0.672f, worktop_height_m - 0.3f);
  Mesh mesh = panel(foot, {0.24f, 0, 0}, {0, 0, 0.306f}, 0.012f);
  for (glm::vec3& p : mesh.positions) p.y += 0.007f * std::sin(60.0f * p.x) * (foot.z + 0.306f - p.z);
  mesh.normals.assign(mesh.normals.size(), glm::vec3(0.0f));
  fill_normals(mesh);
  append(mesh, panel({foot.x, foot.y, worktop_height_m + 0.006f}, {0.24f, 0, 0}, {0, 0.12f, 0}, 0.012f));
  add_part(model, "cloth", std::move(mesh), cloth);
}

}  // namespace

void add_shade(scene::Model& model, glm::vec3 foot, float radius_m) {
  const float half = 1.6f * radius_m;
  const float lift_m = 0.0009f + 0.003f * radius_m;  // of two that overlap, rays would hit either at random
  Mesh mesh =
      panel(foot + glm::vec3(-half, -half, lift_m), {2.0f * half, 0, 0}, {0, 2.0f * half, 0}, 0.5f * half);
  for (glm::vec2& uv : mesh.uvs) uv = uv / (2.0f * half) + glm::vec2(0.0f, 1.0f);
  add_part(model, "shade", std::move(mesh), shade);
}

void add_crockery(scene::Model& model) {
  const auto on_worktop = [](float x, float y) { return glm::vec3(x, y, worktop_height_m); };
  const auto on_shelf = [](float x) { return glm::vec3(x, -0.105f, shelf_height_m); };
  add_mug(model, on_worktop(-0.62f, -0.52f), -2.2f, blue),
      add_shade(model, on_worktop(-0.62f, -0.52f), 0.042f);
  add_plates(model, on_worktop(-0.98f, -0.3f)), add_shade(model, on_worktop(-0.98f, -0.3f), 0.1f);
  add_pot(model, on_worktop(0.2f, -0.14f)), add_shade(model, on_worktop(0.2f, -0.14f), 0.05f);
  add_jar(model, on_worktop(-1.3f, -0.15f), 0.2f, china), add_shade(model, on_worktop(-1.3f, -0.15f), 0.04f);
  add_board(model);
  add_cloth(model);
  for (int i = 0; i < 4; ++i)
    add_jar(model, on_shelf(-1.2f + 0.1f * float(i)), 0.12f + 0.02f * float(i % 3),
            i % 2 == 0 ? honey : china);
  for (int i = 0; i < 4; ++i)
    add_mug(model, on_shelf(-0.72f + 0.12f * float(i)), -1.2f + 0.4f * float(i % 2),
            i % 2 == 0 ? china : blue);
  add_plates(model, on_shelf(-0.12f));
  add_jar(model, on_shelf(0.1f), 0.15f, lemon), add_jar(model, on_shelf(0.21f), 0.13f, honey);
}

}  // namespace parvis::kitchen
