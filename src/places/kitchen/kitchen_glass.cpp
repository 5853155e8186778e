#include "places/kitchen/kitchen_glass.h"

#include <cmath>

#include "places/kitchen/kitchen_room.h"
#include "synthesis/round_mesh.h"

namespace parvis::kitchen {
namespace {

using synthesis::Outline, synthesis::turned;

constexpr int glass_rings = 48, glass_sides = 96;  // the ray tracer follows the facets

/// An ellipsoid that stands on the origin.
scene::Model glass_body(const char* name, glm::vec3 radii, glm::vec3 absorption_per_m) {
  scene::Model model;
  model.name = model.nodes[0].name = name;
  scene::Material glass;
  glass.name = "solid glass", glass.ior = 1.5f, glass.roughness = 0.0f;
  glass.absorption_per_m = absorption_per_m, glass.is_mirror_like = true;
  model.materials = {glass};
  Outline outline;
  for (int i = 0; i <= glass_rings; ++i) {
    const float turn = 3.14159265f * float(i) / float(glass_rings);
    outline.emplace_back(std::sin(turn), -std::cos(turn));
  }
  scene::Part part;
  part.object = name;
  part.mesh = turned(outline, glass_sides);
  for (std::size_t i = 0; i < part.mesh.positions.size(); ++i) {
    const glm::vec3 on_ball = glm::normalize(part.mesh.positions[i]);
    part.mesh.positions[i] = radii * on_ball + glm::vec3(0, 0, radii.z);
    part.mesh.normals[i] = glm::normalize(on_ball / radii);
  }
  model.parts = {part};
  return model;
}

}  // namespace

std::vector<KitchenMirror> kitchen_glass() {
  std::vector<KitchenMirror> bodies;
  bodies.push_back(
      {glass_body("glass_ball", glm::vec3(0.06f), glm::vec3(0.2f)), {-0.02f, -0.52f, worktop_height_m}});
  bodies.push_back({glass_body("glass_egg", {0.06f, 0.042f, 0.042f}, {3.0f, 0.6f, 1.5f}),
                    {-0.3f, -0.53f, worktop_height_m},
                    25.0f});
  return bodies;
}

}  // namespace parvis::kitchen
