#include "places/square/fountain.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "base/colour.h"
#include "base/random.h"
#include "life/people/person_model.h"
#include "scene/data/deformation.h"
#include "synthesis/round_mesh.h"
#include "synthesis/wall_texture.h"

namespace parvis::square {
namespace {

using synthesis::Outline, synthesis::smooth, synthesis::turned, synthesis::tube, synthesis::panelled_box;

constexpr int round_sides = 56;
constexpr float water_m = 0.74f, pedestal_half_m = 1.15f, pedestal_m = 5.6f, statue_scale = 2.1f;
enum Stuff : int { stone, marble, water, jet, bronze };

std::vector<scene::Material> materials(scene::Model& model) {
  synthesis::SurfaceCanvas canvas(512, 512, 4.08f, 4.08f);
  synthesis::paint_wall(canvas, synthesis::Wall::plaster, glm::vec3(0.8f), 5);
  synthesis::SurfacePictures grain = canvas.pictures(2, 4);
  const auto add = [&](const char* name, Image8 image, bool is_srgb) {
    scene::Texture texture;
    texture.name = name, texture.image = std::move(image), texture.is_srgb = is_srgb;
    model.textures.push_back(std::move(texture));
  };
  add("grain", std::move(grain.colour), true), add("grain_normal", std::move(grain.normal), false);
  std::vector<scene::Material> all(5);
  const auto set = [&](Stuff stuff, const char* name, glm::vec3 colour, float roughness) -> scene::Material& {
    scene::Material& m = all[std::size_t(stuff)];
    m.name = name, m.base_colour = colour, m.roughness = roughness;
    return m;
  };
  for (scene::Material* m :
       {&set(stone, "fountain stone", linear_from_srgb8(0xB4, 0xA9, 0x95) / 0.8f, 0.8f),
        &set(marble, "fountain marble", linear_from_srgb8(0xC8, 0xC0, 0xB0) / 0.8f, 0.55f)}) {
    m->base_colour = glm::min(m->base_colour, glm::vec3(0.95f));
    m->base_colour_texture = 0, m->normal_texture = 1;
    m->texture_from_mesh_uv = glm::mat3(1.0f / 4.08f, 0, 0, 0, 1.0f / 4.08f, 0, 0, 0, 1);
  }
  scene::Material& w = set(water, "fountain water", {0.03f, 0.075f, 0.07f}, 0.04f);
  w.clear_coat = 1.0f, w.clear_coat_roughness = 0.03f, w.is_mirror_like = true;
  scene::Material& j = set(jet, "fountain jet", glm::vec3(0.85f), 0.3f);
  j.alpha = 0.34f, j.alpha_mode = scene::Alpha::blend, j.is_double_sided = true, j.translucency = 0.5f;
  set(bronze, "bronze", {0.105f, 0.125f, 0.088f}, 0.42f).metallic = 0.35f;
  return all;
}

/// Texture coordinates in metres, by the side on which a corner lies.
void add(scene::Model& model, const char* name, Mesh mesh, Stuff stuff) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3 p = mesh.positions[i], n = mesh.normals[i];
    if (stuff <= marble)
      mesh.uvs[i] = std::abs(n.z) > 0.7f ? glm::vec2(p.x, -p.y)
                                         : glm::vec2(std::abs(n.x) > std::abs(n.y) ? p.y : p.x, -p.z);
  }
  scene::Part part;
  part.object = name, part.mesh = std::move(mesh), part.material = stuff;
  part.casts_shadow = stuff != jet && stuff != water;
  model.parts.push_back(std::move(part));
}

/// Courses of a square pillar, each with its half width below and above.
struct Course {
  float z, half;
};
Mesh square_pillar(const std::vector<Course>& courses) {
  Mesh mesh;
  const auto corner = [](float half, int i, float z) {
    return glm::vec3(i == 1 || i == 2 ? half : -half, i >= 2 ? half : -half, z);
  };
  const auto quad = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    const glm::vec3 across = glm::cross(c - a, d - b);
    if (glm::length(across) < 1e-7f) return;
    const std::uint32_t first = std::uint32_t(mesh.positions.size());
    for (const glm::vec3& p : {a, b, c, d})
      mesh.positions.push_back(p), mesh.normals.push_back(glm::normalize(across)),
          mesh.uvs.emplace_back(0.0f);
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  };
  for (std::size_t i = 0; i + 1 < courses.size(); ++i)
    for (int side = 0; side < 4; ++side) {
      const Course &p = courses[i], &q = courses[i + 1];
      quad(corner(p.half, side, p.z), corner(p.half, (side + 1) % 4, p.z),
           corner(q.half, (side + 1) % 4, q.z), corner(q.half, side, q.z));
    }
  const Course& top = courses.back();
  quad(corner(top.half, 0, top.z), corner(top.half, 1, top.z), corner(top.half, 2, top.z),
       corner(top.half, 3, top.z));
  return mesh;
}

void add_basin(scene::Model& model) {
  add(model, "steps",
      turned({{6.9f, 0.0f}, {6.9f, 0.16f}, {6.3f, 0.16f}, {6.3f, 0.32f}, {5.4f, 0.32f}}, round_sides), stone);
  add(model, "basin wall",
      turned(smooth({{5.55f, 0.3f},
                     {5.55f, 0.42f},
                     {5.38f, 0.48f},
                     {5.34f, 0.8f},
                     {5.5f, 0.86f},
                     {5.6f, 0.92f},
                     {5.58f, 1.0f},
                     {5.2f, 1.02f},
                     {5.02f, 0.98f},
                     {5.0f, 0.6f}},
                    3),
             round_sides),
      marble);
  Mesh surface;
  constexpr int rings = 10;
  for (int r = 0; r <= rings; ++r)
    for (int i = 0; i <= round_sides; ++i) {
      const float radius = 5.05f * float(r) / float(rings),
                  angle = 2.0f * std::numbers::pi_v<float> * float(i) / float(round_sides);
      surface.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), water_m);
      const float wave = 0.035f * std::sin(5.0f * radius + 0.6f * std::sin(3.0f * angle));
      surface.normals.push_back(
          glm::normalize(glm::vec3(wave * std::cos(angle), wave * std::sin(angle), 1.0f)));
      surface.uvs.emplace_back(0.0f);
    }
  for (int r = 0; r < rings; ++r)
    for (int i = 0; i < round_sides; ++i) {
      const std::uint32_t a = std::uint32_t(r * (round_sides + 1) + i), b = a + round_sides + 1;
      surface.indices.insert(surface.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  add(model, "water", std::move(surface), water);
}

void add_pedestal(scene::Model& model) {
  const float w = pedestal_half_m;
  add(model, "pedestal foot",
      square_pillar(
          {{0.3f, w + 1.0f}, {1.2f, w + 1.0f}, {1.3f, w + 0.85f}, {1.5f, w + 0.8f}, {1.5f, w + 0.5f}}),
      stone);
  add(model, "pedestal",
      square_pillar({{1.5f, w + 0.32f},
                     {1.75f, w + 0.32f},
                     {1.85f, w + 0.18f},
                     {2.05f, w + 0.12f},
                     {2.1f, w},
                     {4.5f, w - 0.08f},
                     {4.55f, w},
                     {4.75f, w + 0.05f},
                     {4.9f, w + 0.28f},
                     {5.1f, w + 0.32f},
                     {5.1f, w - 0.1f},
                     {pedestal_m, w - 0.16f}}),
      marble);
  // Panels on its sides, and a bowl with a spout before each of them.
  for (int side = 0; side < 4; ++side) {
    const glm::mat4 turn =
        glm::rotate(glm::mat4(1.0f), 0.5f * std::numbers::pi_v<float> * float(side), {0, 0, 1});
    const auto turned_to = [&](const Mesh& mesh) {
      Mesh result;
      append(result, mesh, turn);
      return result;
    };
    add(model, "panel", turned_to(panelled_box({w - 0.06f, -0.75f, 2.5f}, {w + 0.03f, 0.75f, 4.1f}, 10.0f)),
        stone);
    add(model, "tablet", turned_to(panelled_box({w - 0.05f, -0.6f, 2.65f}, {w + 0.05f, 0.6f, 3.95f}, 10.0f)),
        marble);
    Mesh bowl;
    append(bowl,
           turned(smooth({{0.2f, 1.2f},
                          {0.26f, 1.28f},
                          {0.55f, 1.42f},
                          {0.72f, 1.56f},
                          {0.74f, 1.62f},
                          {0.66f, 1.6f},
                          {0.3f, 1.5f},
                          {0.0f, 1.48f}},
                         3),
                  28),
           glm::translate(glm::mat4(1.0f), {w + 0.95f, 0, 0}));
    add(model, "bowl", turned_to(bowl), marble);
    add(model, "mask",
        turned_to(turned(
            smooth({{0.0f, -0.2f}, {0.16f, -0.14f}, {0.2f, 0.0f}, {0.16f, 0.16f}, {0.0f, 0.2f}}, 3), 16)),
        bronze);
    Mesh& mask = model.parts.back().mesh;
    for (glm::vec3& p : mask.positions) p += glm::vec3(turn * glm::vec4(w + 0.12f, 0, spout_m, 0));
    std::vector<synthesis::TubeRing> fall, spill;
    for (int i = 0; i <= 10; ++i) {
      const float t = float(i) / 10.0f;
      fall.push_back({{w + 0.28f + 0.62f * t, 0.0f, spout_m - 0.4f * t * t}, 0.02f + 0.02f * t});
    }
    add(model, "jet", turned_to(tube(fall, 8)), jet);
    for (const float angle : {-0.8f, 0.0f, 0.8f}) {
      spill.clear();
      for (int i = 0; i <= 10; ++i) {
        const float t = float(i) / 10.0f, reach = 0.72f + 0.3f * t;
        spill.push_back({{w + 0.95f + reach * std::cos(angle), reach * std::sin(angle), 1.6f - 0.86f * t * t},
                         0.014f + 0.022f * t});
      }
      add(model, "jet", turned_to(tube(spill, 8)), jet);
    }
  }
}

/// A generated man in bronze; his posture is that of somebody who waits.
void add_statue(scene::Model& model) {
  const people::Someone who = people::someone(52, people::Sex::male, 48.0f);
  const people::PersonMesh person = people::make_person(who, people::colours_of(who, 52));
  const scene::Model& body = *person.model;
  std::vector<glm::mat4> pose = scene::rest_pose(body);
  for (const scene::Animation& animation : body.animations)
    if (animation.name == "wait") pose = scene::pose_at(body, animation, 0.4f);
  const glm::mat4 place =
      glm::scale(glm::translate(glm::mat4(1.0f), {0, 0, pedestal_m}), glm::vec3(statue_scale));
  for (const scene::Part& part : body.parts) {
    Mesh posed = part.mesh, mesh;
    if (part.deformation) scene::deform(*part.deformation, part.deformation->weights, pose, part.node, posed);
    append(mesh, posed, place * pose[std::size_t(part.node)]);
    mesh.colours.clear(), mesh.second_uvs.clear();
    if (mesh.uvs.size() != mesh.positions.size()) mesh.uvs.assign(mesh.positions.size(), glm::vec2(0.0f));
    add(model, "statue", std::move(mesh), bronze);
  }
}

}  // namespace

scene::Model make_fountain() {
  scene::Model model;
  model.name = model.nodes[0].name = "fountain";
  model.materials = materials(model);
  add_basin(model);
  add_pedestal(model);
  add_statue(model);
  return model;
}

}  // namespace parvis::square
