#include "graphics/light/sun_path_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <initializer_list>
#include <vector>

namespace parvis::light {
namespace {

// Radii, of that of the sphere.
constexpr float tube_radius = 0.004f, bead_radius = 0.012f, sun_radius = 0.03f;
constexpr std::size_t tubes_per_day = 40;  // straight ones: the longest day bends them by 9 degrees
constexpr std::size_t beads_per_day = 24;
constexpr std::size_t pieces_per_day = tubes_per_day + beads_per_day;
constexpr int horizon_steps = 96;
constexpr std::size_t ring_node = 0, sun_node = 1, first_day_node = 2;
constexpr std::size_t node_count = first_day_node + (max_path_days + 1) * pieces_per_day;

/// A transform that hides a thing inside the ring, along it. It is not flat: glTF's writer takes transforms
/// apart.
glm::mat4 put_away() {
  constexpr float size = 0.006f;
  return {{0, 0, -size, 0}, {0, size, 0, 0}, {size, 0, 0, 0}, {0, 1, 0, 1}};
}

/// A point, with a normal that points outward from the middle of its tube or bead.
void add_vertex(Mesh& mesh, glm::vec3 middle, glm::vec3 outward, float radius) {
  mesh.positions.push_back(middle + radius * outward);
  mesh.normals.push_back(outward);
  mesh.uvs.emplace_back(0.0f);
}

/// A tube of six sides along a line; `ups` are across it at each of its points.
Mesh tube_mesh(const std::vector<glm::vec3>& line, const std::vector<glm::vec3>& ups, float radius) {
  constexpr std::uint32_t sides = 6;
  Mesh mesh;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const glm::vec3 along = line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0];
    const glm::vec3 aside = glm::normalize(glm::cross(along, ups[i]));
    for (std::uint32_t k = 0; k < sides; ++k) {
      const float turn = 6.2831853f * float(k) / float(sides);
      add_vertex(mesh, line[i], std::cos(turn) * aside + std::sin(turn) * ups[i], radius);
    }
  }
  for (std::uint32_t i = 0; i + 1 < line.size(); ++i)
    for (std::uint32_t k = 0; k < sides; ++k) {
      const std::uint32_t a = sides * i + k, b = sides * i + (k + 1) % sides;
      for (const std::uint32_t corner : {a, b, b + sides, a, b + sides, a + sides})
        mesh.indices.push_back(corner);
    }
  return mesh;
}

Mesh ring_mesh() {
  std::vector<glm::vec3> line;
  line.reserve(horizon_steps + 1);
  for (int i = 0; i <= horizon_steps; ++i) {
    const float turn = 6.2831853f * float(i) / float(horizon_steps);
    line.emplace_back(std::sin(turn), std::cos(turn), 0.0f);
  }
  return tube_mesh(line, line, 0.5f * tube_radius);
}

/// An octahedron.
Mesh bead_mesh() {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {1.0f, -1.0f}) {
      glm::vec3 outward(0.0f);
      outward[axis] = side;
      add_vertex(mesh, glm::vec3(0.0f), outward, bead_radius);
    }
  mesh.indices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  return mesh;
}

/// A ball: a disc from wherever it is seen.
Mesh sun_mesh() {
  constexpr std::uint32_t rows = 10, columns = 20;
  Mesh mesh;
  for (std::uint32_t row = 0; row <= rows; ++row)
    for (std::uint32_t column = 0; column <= columns; ++column) {
      const float polar = 3.14159265f * float(row) / float(rows);
      const float turn = 6.2831853f * float(column) / float(columns);
      add_vertex(mesh, glm::vec3(0.0f),
                 {std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)},
                 sun_radius);
    }
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t a = row * (columns + 1) + column, below = a + columns + 1;
      for (const std::uint32_t corner : {a, below, below + 1, a, below + 1, a + 1})
        mesh.indices.push_back(corner);
    }
  return mesh;
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

/// Adds the part of a node; the nodes are there.
void add_part(scene::Model& model, const Mesh& mesh, std::size_t node, int material) {
  scene::Part part;
  part.mesh = mesh;
  part.material = material;
  part.node = int(node);
  part.casts_shadow = false;
  model.parts.push_back(std::move(part));
}

/// The transform from a tube of length 1 along z about the origin to one between two points of the sphere.
glm::mat4 tube_between(glm::vec3 from, glm::vec3 to) {
  const float length = glm::distance(from, to);
  if (length < 1e-6f) return put_away();
  const glm::vec3 up = glm::normalize(from + to);  // across the tube: both lie on the sphere
  const glm::vec3 along = (to - from) / length;
  return {glm::vec4(glm::cross(up, along), 0.0f), glm::vec4(up, 0.0f), glm::vec4(to - from, 0.0f),
          glm::vec4(0.5f * (from + to), 1.0f)};
}

glm::mat4 piece_at(glm::vec3 place) { return glm::translate(glm::mat4(1.0f), place); }

void place_day(PlaceAndTime day, std::span<glm::mat4> pieces) {
  const DaylightHours hours = daylight_hours(day);
  if (hours.is_polar_night()) return;
  const double from = hours.begin_h(), to = hours.end_h();
  const auto sun_at = [&](double hour) {
    day.time_of_day_h = hour;
    return sun_of(day);
  };
  glm::vec3 last(sun_at(from).direction());
  for (std::size_t i = 0; i < tubes_per_day; ++i) {
    const glm::vec3 next(sun_at(from + (to - from) * double(i + 1) / double(tubes_per_day)).direction());
    pieces[i] = tube_between(last, next);
    last = next;
  }
  for (std::size_t hour = 0; hour < beads_per_day; ++hour)
    if (const SolarPosition sun = sun_at(double(hour)); sun.elevation_deg() > 0.0)
      pieces[tubes_per_day + hour] = piece_at(glm::vec3(sun.direction()));
}

}  // namespace

std::shared_ptr<const scene::Model> sun_path_model() {
  auto model = std::make_shared<scene::Model>();
  const int of_horizon = 0, of_days = 1, of_today = 2, of_sun = 3;
  for (const glm::vec3 colour : std::initializer_list<glm::vec3>{
           {0.15f, 0.15f, 0.15f}, {0.9f, 0.45f, 0.05f}, {0.9f, 0.7f, 0.1f}, {1.0f, 0.85f, 0.2f}})
    model->materials.push_back(material_of(colour));
  model->nodes.resize(node_count);
  for (std::size_t i = 1; i < node_count; ++i) model->nodes[i].parent = int(ring_node);
  const Mesh one_tube = tube_mesh({{0, 0, -0.5f}, {0, 0, 0.5f}}, {{0, 1, 0}, {0, 1, 0}}, tube_radius);
  const Mesh one_bead = bead_mesh();
  model->parts.reserve(node_count);
  add_part(*model, ring_mesh(), ring_node, of_horizon);
  add_part(*model, sun_mesh(), sun_node, of_sun);
  for (std::size_t day = 0; day <= max_path_days; ++day)
    for (std::size_t i = 0; i < pieces_per_day; ++i)
      add_part(*model, i < tubes_per_day ? one_tube : one_bead, first_day_node + day * pieces_per_day + i,
               day < max_path_days ? of_days : of_today);
  return model;
}

std::vector<glm::mat4> sun_path_pose(const PlaceAndTime& now, std::span<const int> days) {
  assert(days.size() <= max_path_days);
  std::vector<glm::mat4> pose(node_count, put_away());
  pose[ring_node] = glm::mat4(1.0f);
  const auto pieces_of = [&](std::size_t day) {
    return std::span(pose).subspan(first_day_node + day * pieces_per_day, pieces_per_day);
  };
  PlaceAndTime day = now;
  for (std::size_t i = 0; i < days.size(); ++i) {
    day.day_of_year = days[i];
    place_day(day, pieces_of(i));
  }
  if (std::ranges::find(days, now.day_of_year) == days.end()) place_day(now, pieces_of(max_path_days));
  place_sun(now, pose);
  return pose;
}

void place_sun(const PlaceAndTime& now, std::vector<glm::mat4>& pose) {
  const SolarPosition sun = sun_of(now);
  pose[sun_node] = sun.elevation_deg() > 0.0 ? piece_at(glm::vec3(sun.direction())) : put_away();
}

}  // namespace parvis::light
