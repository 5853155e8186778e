#include "graphics/light/sun_path_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace parvis::light {
namespace {

constexpr float tube_share = 0.004f, bead_share = 0.012f;  // radii, of that of the sphere
constexpr double step_h = 0.2;
constexpr int horizon_steps = 96;

/// A point, with a normal that points outward from the middle of its tube or bead.
void add_vertex(Mesh& mesh, glm::vec3 middle, glm::vec3 outward, float radius_m) {
  mesh.positions.push_back(middle + radius_m * outward);
  mesh.normals.push_back(outward);
  mesh.uvs.emplace_back(0.0f);
}

/// A tube of six sides along a line on the sphere about the origin.
void add_tube(Mesh& mesh, const std::vector<glm::vec3>& line, float radius_m) {
  constexpr std::uint32_t sides = 6;
  const auto first = std::uint32_t(mesh.positions.size());
  for (std::size_t i = 0; i < line.size(); ++i) {
    const glm::vec3 along = line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0];
    const glm::vec3 up = glm::normalize(line[i]), aside = glm::normalize(glm::cross(along, up));
    for (std::uint32_t k = 0; k < sides; ++k) {
      const float turn = 6.2831853f * float(k) / float(sides);
      add_vertex(mesh, line[i], std::cos(turn) * aside + std::sin(turn) * up, radius_m);
    }
  }
  for (std::uint32_t i = 0; i + 1 < line.size(); ++i)
    for (std::uint32_t k = 0; k < sides; ++k) {
      const std::uint32_t a = first + sides * i + k, b = first + sides * i + (k + 1) % sides;
      for (const std::uint32_t corner : {a, b, b + sides, a, b + sides, a + sides})
        mesh.indices.push_back(corner);
    }
}

/// An octahedron.
void add_bead(Mesh& mesh, glm::vec3 middle, float radius_m) {
  const auto first = std::uint32_t(mesh.positions.size());
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {1.0f, -1.0f}) {
      glm::vec3 outward(0.0f);
      outward[axis] = side;
      add_vertex(mesh, middle, outward, radius_m);
    }
  constexpr std::array<std::uint32_t, 24> corners{0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                                  2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  for (const std::uint32_t corner : corners) mesh.indices.push_back(first + corner);
}

/// Blended, which leaves it out of all that hides light.
scene::Material material_of(glm::vec3 colour) {
  scene::Material material;
  material.base_colour = colour;
  material.alpha = 0.9f;
  material.alpha_mode = scene::Alpha::blend;
  material.is_double_sided = true;
  return material;
}

void add_part(scene::Model& model, Mesh mesh, glm::vec3 colour) {
  scene::Part part;
  part.mesh = std::move(mesh);
  part.material = int(model.materials.size());
  part.casts_shadow = false;
  model.materials.push_back(material_of(colour));
  model.parts.push_back(std::move(part));
}

void add_day(Mesh& mesh, PlaceAndTime day, float radius_m) {
  std::vector<glm::vec3> line;
  for (const SolarPosition& sun : sun_path(day, step_h))
    line.push_back(radius_m * glm::vec3(sun.direction()));
  if (line.size() < 2) return;
  add_tube(mesh, line, tube_share * radius_m);
  for (int hour = 0; hour < 24; ++hour) {
    day.time_of_day_h = hour;
    const SolarPosition sun = sun_of(day);
    if (sun.elevation_deg() > 0.0)
      add_bead(mesh, radius_m * glm::vec3(sun.direction()), bead_share * radius_m);
  }
}

}  // namespace

std::shared_ptr<const scene::Model> sun_path_model(PlaceAndTime place, std::span<const int> days,
                                                   float radius_m) {
  auto model = std::make_shared<scene::Model>();
  Mesh arcs, horizon;
  for (const int day : days) {
    place.day_of_year = day;
    add_day(arcs, place, radius_m);
  }
  std::vector<glm::vec3> ring;
  for (int i = 0; i <= horizon_steps; ++i) {
    const float turn = 6.2831853f * float(i) / float(horizon_steps);
    ring.emplace_back(radius_m * std::sin(turn), radius_m * std::cos(turn), 0.0f);
  }
  add_tube(horizon, ring, 0.5f * tube_share * radius_m);
  if (!arcs.indices.empty()) add_part(*model, std::move(arcs), {0.9f, 0.45f, 0.05f});
  add_part(*model, std::move(horizon), {0.15f, 0.15f, 0.15f});
  return model;
}

}  // namespace parvis::light
