#include "places/paper_city/mirror_bodies.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <numbers>

namespace parvis::city {
namespace {

constexpr int body_rings = 96, body_sides = 64, fin_rings = 24, fin_sides = 32;

/// A closed section of a body: an ellipse with these half axes, whose cross product points back to the
/// sections before it.
struct Section {
  glm::vec3 centre, across, up;
};

/// The skin through sections for fractions 0 to 1 of its length: closed where the first and the last are
/// points.
Mesh skin(int rings, int sides, const std::function<Section(float)>& section) {
  Mesh mesh;
  for (int ring = 0; ring <= rings; ++ring) {
    const Section at = section(float(ring) / float(rings));
    for (int side = 0; side < sides; ++side) {
      const float turn = 2.0f * glm::pi<float>() * float(side) / float(sides);
      mesh.positions.push_back(at.centre + std::cos(turn) * at.across + std::sin(turn) * at.up);
      mesh.uvs.emplace_back(0.0f);
    }
  }
  const auto vertex = [&](int ring, int side) { return std::uint32_t(ring * sides + side % sides); };
  for (int ring = 0; ring < rings; ++ring)
    for (int side = 0; side < sides; ++side)
      mesh.indices.insert(mesh.indices.end(),
                          {vertex(ring, side), vertex(ring + 1, side), vertex(ring + 1, side + 1),
                           vertex(ring, side), vertex(ring + 1, side + 1), vertex(ring, side + 1)});
  fill_normals(mesh);
  return mesh;
}

/// A section of the whale's trunk: how far along, how high its middle, half its width and height; metres.
struct TrunkSection {
  float x, z, half_width, half_height;
};
constexpr TrunkSection trunk_sections[]{
    {6.10f, -0.10f, 0.0f, 0.0f},   {5.95f, -0.08f, 0.55f, 0.40f}, {5.40f, -0.02f, 1.00f, 0.80f},
    {4.40f, 0.05f, 1.38f, 1.15f},  {3.20f, 0.10f, 1.62f, 1.38f},  {1.80f, 0.10f, 1.70f, 1.46f},
    {0.20f, 0.12f, 1.54f, 1.36f},  {-1.40f, 0.18f, 1.18f, 1.08f}, {-2.90f, 0.28f, 0.76f, 0.74f},
    {-4.10f, 0.36f, 0.44f, 0.48f}, {-5.00f, 0.40f, 0.24f, 0.28f}, {-5.60f, 0.42f, 0.12f, 0.12f},
    {-5.90f, 0.42f, 0.0f, 0.0f}};

float through(float before, float from, float to, float after, float t) {  // Catmull and Rom's spline
  return from + 0.5f * t *
                    (to - before +
                     t * (2.0f * before - 5.0f * from + 4.0f * to - after +
                          t * (3.0f * (from - to) + after - before)));
}

Section trunk_section(float fraction) {
  constexpr int last = int(std::size(trunk_sections)) - 1;
  const float at = fraction * float(last);
  const int i = std::min(int(at), last - 1);
  const float t = at - float(i);
  const auto value = [&](float TrunkSection::*member) {
    return through(trunk_sections[std::max(i - 1, 0)].*member, trunk_sections[i].*member,
                   trunk_sections[i + 1].*member, trunk_sections[std::min(i + 2, last)].*member, t);
  };
  return {{value(&TrunkSection::x), 0.0f, value(&TrunkSection::z)},
          {0.0f, std::max(value(&TrunkSection::half_width), 0.0f), 0.0f},
          {0.0f, 0.0f, std::max(value(&TrunkSection::half_height), 0.0f)}};
}

/// A blade that runs from its root to its tip, swept back, widest near the root.
Mesh fin(glm::vec3 root, glm::vec3 tip, float chord_m, glm::vec3 thick) {
  return skin(fin_rings, fin_sides, [=](float fraction) {
    const float width =
        0.5f * chord_m * std::sqrt(std::max(1.0f - fraction * fraction, 0.0f)) * (1.0f - 0.35f * fraction);
    const glm::vec3 sweep(-0.55f * fraction * fraction * glm::length(tip - root), 0.0f, 0.0f);
    return Section{glm::mix(root, tip, fraction) + sweep, glm::vec3(-width, 0.0f, 0.0f),
                   0.14f * width * thick};
  });
}

scene::Model of_metal(const char* name, std::vector<Mesh> meshes) {
  scene::Model model;
  model.name = name;
  scene::Material metal;
  metal.name = "metal";
  metal.base_colour = {0.80f, 0.81f, 0.83f};
  metal.metallic = 1.0f;
  metal.roughness = 0.04f;
  metal.is_mirror_like = true;
  model.materials.push_back(metal);
  for (Mesh& mesh : meshes) model.parts.push_back({name, std::move(mesh), 0, 0, true});
  return model;
}

}  // namespace

scene::Model make_ball() {
  return of_metal("ball", {skin(body_rings, body_sides, [](float fraction) {
                    const float polar = glm::pi<float>() * fraction, radius = std::sin(polar);
                    return Section{{0.0f, 0.0f, std::cos(polar)}, {radius, 0.0f, 0.0f}, {0.0f, radius, 0.0f}};
                  })});
}

scene::Model make_whale() {
  std::vector<Mesh> meshes{skin(body_rings, body_sides, trunk_section)};
  for (const float side : {-1.0f, 1.0f}) {
    meshes.push_back(fin({-5.3f, 0.0f, 0.42f}, {-5.7f, side * 2.0f, 0.6f}, 1.5f, {0.0f, 0.0f, -side}));
    meshes.push_back(fin({2.6f, side * 1.2f, -0.6f}, {2.0f, side * 3.6f, -1.3f}, 1.3f, {0.0f, 0.0f, -side}));
  }
  meshes.push_back(fin({-1.6f, 0.0f, 1.0f}, {-2.0f, 0.0f, 1.85f}, 1.3f, {0.0f, 1.0f, 0.0f}));
  return of_metal("whale", std::move(meshes));
}

}  // namespace parvis::city
