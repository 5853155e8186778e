#include "graphics/shading/body_shade.h"

#include <algorithm>
#include <vector>

namespace parvis::shading {
namespace {

using glm::uint;

constexpr float max_body_m = 60.0f;    // a long tram
constexpr float fading_begins = 0.8f;  // of the distance to where bodies are left out

glm::mat3 world_from_box(const Body& body) {  // the rows hold a rotation: its inverse is its transpose
  return {vec3(body.box_from_world[0]), vec3(body.box_from_world[1]), vec3(body.box_from_world[2])};
}

vec3 centre_of(const Body& body) {
  return -(world_from_box(body) *
           vec3(body.box_from_world[0].w, body.box_from_world[1].w, body.box_from_world[2].w));
}

/// Half the size of the axis-aligned box around a body.
vec3 half_extent(const Body& body) {
  const glm::mat3 axes = world_from_box(body);
  return glm::abs(axes[0]) * body.half_size_m.x + glm::abs(axes[1]) * body.half_size_m.y +
         glm::abs(axes[2]) * body.half_size_m.z;
}

/// Adds a body to the cells that its shade reaches.
void enter(BodyShade& shade, int index) {
  const Body& body = shade.bodies[index];
  const glm::vec2 centre = glm::vec2(centre_of(body)) - glm::vec2(shade.body_grid);
  const glm::vec2 reach = glm::vec2(half_extent(body)) + body_reach_m;
  const glm::ivec2 last(body_cells_per_side - 1);
  const glm::ivec2 from = glm::max(glm::ivec2(glm::floor((centre - reach) / body_cell_m)), glm::ivec2(0));
  const glm::ivec2 to = glm::min(glm::ivec2(glm::floor((centre + reach) / body_cell_m)), last);
  for (int y = from.y; y <= to.y; ++y)
    for (int x = from.x; x <= to.x; ++x) {
      const int cell = y * body_cells_per_side + x;
      glm::uint& word = shade.body_cells[cell / 4][cell % 4];
      int taken = 0;
      while (taken < bodies_per_cell && (word >> (8 * taken)) & 255u) ++taken;
      if (taken < bodies_per_cell) word |= glm::uint(index + 1) << (8 * taken);
    }
}

/// Gives the shared function what a shader has in its block.
struct BodyShadeLookup {
  const vec4& body_grid;
  const glm::uvec4* body_cells;
  const Body* bodies;

#include "graphics/shading/body_shade_lookup.glsl"
};

}  // namespace

std::optional<Body> body_of(const Bounds& in_model, const BodyShape& shape, const glm::mat4& world_from_model,
                            int object) {
  if (in_model.empty()) return std::nullopt;
  const Bounds hull{in_model.min + shape.box.min * in_model.size(),
                    in_model.min + shape.box.max * in_model.size()};
  Body body{};
  glm::mat3 axes;  // of the box, in the world
  for (int i = 0; i < 3; ++i) {
    const vec3 axis(world_from_model[i]);
    const float scale = glm::length(axis);
    const float size_m = scale * hull.size()[i];
    if (!(scale > 0.0f) || !(size_m < max_body_m)) return std::nullopt;
    axes[i] = axis / scale;
    body.half_size_m[i] = 0.5f * size_m;
  }
  const vec3 centre(world_from_model * vec4(hull.centre(), 1.0f));
  for (int i = 0; i < 3; ++i) body.box_from_world[i] = vec4(axes[i], -dot(axes[i], centre));
  body.half_size_m.w = float(object + 1);
  body.coverage = vec4(shape.coverage, 0.0f);
  return body;
}

BodyShade make_body_shade(std::span<const Body> bodies, vec3 viewer) {
  BodyShade shade{};
  const float half_m = 0.5f * body_cell_m * float(body_cells_per_side);
  shade.body_grid = vec4(viewer.x - half_m, viewer.y - half_m, 0.0f, 0.0f);
  std::vector<std::pair<float, const Body*>> near;  // by distance
  for (const Body& body : bodies) {
    const vec3 away = centre_of(body) - viewer;
    const float distance_m = std::max(std::abs(away.x), std::abs(away.y));
    if (distance_m < half_m + max_body_m) near.emplace_back(distance_m, &body);
  }
  std::sort(near.begin(), near.end());
  // Bodies fade before they are left out: at the border of the grid, or where there are too many.
  float last_m = half_m - body_reach_m;
  if (near.size() > std::size_t(max_bodies)) last_m = std::min(last_m, near[max_bodies].first);
  for (std::size_t i = 0; i < std::min(near.size(), std::size_t(max_bodies)); ++i) {
    shade.bodies[i] = *near[i].second;
    shade.bodies[i].coverage *= 1.0f - smoothstep(fading_begins * last_m, last_m, near[i].first);
    enter(shade, int(i));
  }
  return shade;
}

float sky_share_beside_bodies(const BodyShade& shade, vec3 position, vec3 normal, int object) {
  return BodyShadeLookup{shade.body_grid, shade.body_cells, shade.bodies}.sky_share_beside_bodies(
      position, normal, object);
}

}  // namespace parvis::shading
