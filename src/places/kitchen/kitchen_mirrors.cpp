#include "places/kitchen/kitchen_mirrors.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "places/kitchen/kitchen_room.h"
#include "synthesis/round_mesh.h"

namespace parvis::kitchen {
namespace {

using synthesis::Outline, synthesis::smooth, synthesis::turned, synthesis::tube;

constexpr int mirror_sides = 64, mirror_parts = 6;
enum Surface : int { polished, black_handle, clear, brushed };

std::vector<scene::Material> materials() {
  scene::Material steel, handle, glass, dull;
  steel.name = "steel", steel.base_colour = {0.80f, 0.80f, 0.79f};
  steel.metallic = 1.0f, steel.roughness = 0.04f, steel.is_mirror_like = true;
  handle.name = "black", handle.base_colour = glm::vec3(0.02f), handle.roughness = 0.4f;
  glass.name = "glass", glass.base_colour = {0.55f, 0.62f, 0.6f};
  glass.alpha = 0.3f, glass.roughness = 0.05f, glass.clear_coat = 1.0f;
  glass.alpha_mode = scene::Alpha::blend, glass.is_mirror_like = true;
  dull.name = "brushed", dull.base_colour = {0.72f, 0.72f, 0.7f}, dull.metallic = 1.0f, dull.roughness = 0.3f;
  return {steel, handle, glass, dull};
}

scene::Model model_of(const char* name) {
  scene::Model model;
  model.name = name;
  model.nodes[0].name = name;
  model.materials = materials();
  return model;
}

void add(scene::Model& model, const char* name, const Mesh& mesh, Surface surface,
         const glm::mat4& model_from_mesh = glm::mat4(1.0f)) {
  scene::Part part;
  part.object = name, part.material = surface;
  append(part.mesh, mesh, model_from_mesh);
  part.casts_shadow = surface != clear;
  model.parts.push_back(std::move(part));
}

void add_turned(scene::Model& model, const char* name, const Outline& outline, Surface surface = polished) {
  add(model, name, turned(smooth(outline, mirror_parts), mirror_sides), surface);
}

/// A bar that leaves a pan's wall and rises a little.
void add_handle(scene::Model& model, float radius, float height, float length) {
  std::vector<synthesis::TubeRing> rings;
  for (int i = 0; i <= 10; ++i) {
    const float fraction = float(i) / 10.0f;
    rings.push_back({{radius - 0.002f + length * fraction, 0.0f, height + 0.03f * fraction * fraction},
                     0.0085f - 0.002f * std::cos(6.2831853f * fraction)});
  }
  add(model, "handle", tube(rings), black_handle);
}

scene::Model kettle() {
  scene::Model model = model_of("kettle");
  add_turned(model, "body",
             {{0.0f, 0.0f},
              {0.06f, 0.0f},
              {0.098f, 0.006f},
              {0.111f, 0.03f},
              {0.108f, 0.07f},
              {0.094f, 0.11f},
              {0.07f, 0.139f},
              {0.04f, 0.154f},
              {0.0f, 0.16f}});
  add(model, "knob",
      turned(smooth({{0.004f, 0.158f}, {0.006f, 0.166f}, {0.014f, 0.174f}, {0.012f, 0.184f}, {0.0f, 0.188f}},
                    mirror_parts),
             24),
      black_handle);
  // The spout: a cone that bulges a little.
  const glm::mat4 aslant =
      glm::rotate(glm::translate(glm::mat4(1.0f), {-0.082f, 0.0f, 0.07f}), -0.85f, {0, 1, 0});
  add(model, "spout",
      turned(smooth({{0.026f, 0.0f}, {0.0215f, 0.03f}, {0.0165f, 0.06f}, {0.0125f, 0.084f}}, mirror_parts),
             40),
      polished, aslant);
  add(model, "spout inside", turned({{0.0122f, 0.084f}, {0.009f, 0.06f}, {0.0f, 0.058f}}, 24), black_handle,
      aslant);
  std::vector<synthesis::TubeRing> rings;
  for (int i = 0; i <= 20; ++i) {
    const float angle = 3.14159265f * float(i) / 20.0f;
    rings.push_back(
        {{0.088f * std::cos(angle), 0.0f, 0.118f + 0.125f * std::pow(std::max(std::sin(angle), 0.0f), 0.8f)},
         0.0075f});
  }
  add(model, "handle", tube(rings), black_handle);
  return model;
}

/// A concave shell.
scene::Model mixing_bowl() {
  scene::Model model = model_of("mixing_bowl");
  add_turned(
      model, "outside",
      {{0.0f, 0.0f}, {0.05f, 0.001f}, {0.078f, 0.011f}, {0.107f, 0.038f}, {0.125f, 0.076f}, {0.131f, 0.11f}});
  add_turned(model, "rim", {{0.131f, 0.11f}, {0.1345f, 0.1115f}, {0.131f, 0.113f}, {0.1285f, 0.11f}},
             polished);
  add_turned(model, "inside",
             {{0.1285f, 0.11f},
              {0.1225f, 0.076f},
              {0.105f, 0.04f},
              {0.076f, 0.0145f},
              {0.04f, 0.004f},
              {0.0f, 0.002f}});
  return model;
}

scene::Model saucepan(const char* name, float radius, float height, bool has_lid) {
  scene::Model model = model_of(name);
  add_turned(model, "outside",
             {{0.0f, 0.0f},
              {0.7f * radius, 0.0f},
              {0.95f * radius, 0.004f},
              {radius, 0.02f},
              {1.012f * radius, 0.5f * height},
              {radius, height}});
  if (has_lid) {
    add_turned(model, "lid",
               {{radius, height},
                {1.02f * radius, height + 0.003f},
                {0.94f * radius, height + 0.012f},
                {0.6f * radius, height + 0.03f},
                {0.0f, height + 0.038f}});
    add(model, "knob",
        turned(smooth({{0.006f, height + 0.036f},
                       {0.007f, height + 0.048f},
                       {0.017f, height + 0.054f},
                       {0.014f, height + 0.063f},
                       {0.0f, height + 0.066f}},
                      mirror_parts),
               24),
        black_handle);
  } else {
    add_turned(model, "inside",
               {{radius, height},
                {1.0f * radius, 0.5f * height},
                {0.975f * radius, 0.022f},
                {0.9f * radius, 0.009f},
                {0.5f * radius, 0.005f},
                {0.0f, 0.004f}});
  }
  add_handle(model, radius, 0.8f * height, 0.16f);
  return model;
}

/// The concave side of a spoon's bowl, or its back: a shallow dish about (0.05, 0), 1 mm thick.
Mesh spoon_dish(bool is_back) {
  constexpr int rings = 12, around = 40;
  constexpr float half_length = 0.033f, half_width = 0.0215f, depth = 0.0095f, thick = 0.001f;
  Mesh mesh;
  for (int i = 0; i <= rings; ++i)
    for (int k = 0; k < around; ++k) {
      const float r = float(i) / float(rings), angle = 6.2831853f * float(k) / float(around);
      const glm::vec2 at(r * half_length * std::cos(angle), r * half_width * std::sin(angle));
      const glm::vec2 slope =
          2.0f * depth * at / glm::vec2(half_length * half_length, half_width * half_width);
      const glm::vec3 up = glm::normalize(glm::vec3(-slope, 1.0f));
      mesh.positions.push_back(glm::vec3(0.05f + at.x, at.y, depth * (r * r - 1.0f)) -
                               (is_back ? thick : 0.0f) * up);
      mesh.normals.push_back(is_back ? -up : up);
      mesh.uvs.emplace_back(0.0f);
    }
  const auto vertex = [](int i, int k) { return std::uint32_t(i * around + k % around); };
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < around; ++k) {
      std::uint32_t a = vertex(i, k), b = vertex(i + 1, k), c = vertex(i + 1, k + 1), d = vertex(i, k + 1);
      if (is_back) std::swap(b, d);
      mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
    }
  return mesh;
}

/// Lies on its back, or with its concave side down.
scene::Model spoon(const char* name, bool is_turned_over) {
  scene::Model model = model_of(name);
  const float up = is_turned_over ? -1.0f : 1.0f;
  std::vector<synthesis::TubeRing> rings;
  for (int i = 0; i <= 14; ++i) {
    const float fraction = float(i) / 14.0f;
    rings.push_back(
        {{0.02f - 0.125f * fraction, 0.0f, up * 0.0105f * std::sin(3.0f * (1.0f - fraction)) - up * 0.002f},
         0.0028f + 0.0022f * fraction});
  }
  const glm::mat4 lie =
      is_turned_over ? glm::rotate(glm::translate(glm::mat4(1.0f), {0, 0, 0.003f}), 3.14159265f, {1, 0, 0})
                     : glm::translate(glm::mat4(1.0f), {0, 0, 0.011f});
  const glm::mat4 flat = glm::scale(glm::mat4(1.0f), {1.0f, 1.4f, 0.55f});
  add(model, "inside", spoon_dish(false), polished, lie);
  add(model, "back", spoon_dish(true), polished, lie);
  add(model, "handle", tube(rings, 16), brushed, lie * flat);
  return model;
}

scene::Model glass() {
  scene::Model model = model_of("glass");
  add_turned(model, "glass",
             {{0.0f, 0.0f}, {0.027f, 0.0f}, {0.032f, 0.006f}, {0.037f, 0.06f}, {0.039f, 0.125f}}, clear);
  return model;
}

}  // namespace

std::vector<KitchenMirror> kitchen_mirrors() {
  const auto on_worktop = [](float x, float y) { return glm::vec3(x, y, worktop_height_m); };
  const auto on_hob = [](float x, float y) { return glm::vec3(x, y, hob_height_m); };
  std::vector<KitchenMirror> mirrors;
  mirrors.push_back({kettle(), on_worktop(-0.14f, -0.24f), 155.0f, 0.105f});
  mirrors.push_back({mixing_bowl(), on_worktop(-0.44f, -0.36f), 0.0f, 0.08f});
  mirrors.push_back({saucepan("saucepan", 0.095f, 0.1f, true), on_hob(0.49f, -0.22f), 60.0f, 0.09f});
  mirrors.push_back({saucepan("open_pan", 0.12f, 0.085f, false), on_hob(0.78f, -0.36f), -35.0f, 0.11f});
  mirrors.push_back({spoon("spoon", false), on_worktop(-0.03f, -0.52f), 35.0f, 0.0f});
  mirrors.push_back({spoon("turned_spoon", true), on_worktop(-0.26f, -0.56f), 200.0f, 0.0f});
  mirrors.push_back({glass(), on_worktop(0.02f, -0.38f), 0.0f, 0.03f});
  return mirrors;
}

}  // namespace parvis::kitchen
