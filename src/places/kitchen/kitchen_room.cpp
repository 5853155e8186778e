#include "places/kitchen/kitchen_room.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "places/kitchen/kitchen_light.h"
#include "places/kitchen/kitchen_materials.h"
#include "synthesis/round_mesh.h"

namespace parvis::kitchen {
namespace {

using synthesis::smooth, synthesis::turned, synthesis::panel, synthesis::panelled_box;

using enum KitchenMaterial;

// Mirrors show corners exactly and what lies between them straight: the nearer the finer.
constexpr float nearest_cell_m = 0.015f, near_cell_m = 0.03f, cell_m = 0.06f, far_cell_m = 0.15f;
constexpr float east = room_east_m, west = -room_east_m, south = room_south_m, ceiling_m = room_height_m;
constexpr float worktop_front_m = -worktop_m[1];
constexpr float wall_m = 0.16f;  // thick

void add_box(scene::Model& model, const char* name, glm::vec3 low, glm::vec3 high, KitchenMaterial material,
             float cell = cell_m) {
  add_part(model, name, panelled_box(low, high, cell), material);
}

/// A wall with an opening is four panels about it. It goes on for `beyond` past its corners.
void add_window_wall(scene::Model& model, const char* name, float x, float beyond, float cell) {
  const auto piece = [&](float from_y, float to_y, float foot, float head) {
    add_part(model, name, panel({x, from_y, foot}, {0, to_y - from_y, 0}, {0, 0, head - foot}, cell),
             plaster);
  };
  piece(south - beyond, window_south_m, 0, ceiling_m + beyond);
  piece(window_north_m, beyond, 0, ceiling_m + beyond);
  piece(window_south_m, window_north_m, 0, window_foot_m);
  piece(window_south_m, window_north_m, window_top_m, ceiling_m + beyond);
}

void add_shell(scene::Model& model) {
  add_part(model, "floor", panel({west, south, 0}, {east - west, 0, 0}, {0, -south, 0}, far_cell_m), floor);
  add_part(model, "ceiling", panel({west, 0, ceiling_m}, {east - west, 0, 0}, {0, south, 0}, far_cell_m),
           ceiling);
  add_part(model, "north wall", panel({west, 0, 0}, {east - west, 0, 0}, {0, 0, ceiling_m}, far_cell_m),
           plaster);
  add_part(model, "east wall", panel({east, 0, 0}, {0, south, 0}, {0, 0, ceiling_m}, far_cell_m), plaster);
  add_part(model, "south wall", panel({east, south, 0}, {west - east, 0, 0}, {0, 0, ceiling_m}, far_cell_m),
           plaster);
  add_window_wall(model, "west wall", west, 0.0f, far_cell_m);
  add_part(model, "tiled wall",
           panel({west, -0.006f, worktop_height_m}, {tiled_m[0], 0, 0}, {0, 0, tiled_m[1]}, near_cell_m),
           tiles);
}

/// Walls and roof as the sun sees them: shadow maps let light in where a room's panels alone meet.
void add_outside(scene::Model& model) {
  constexpr float w = west - wall_m, e = east + wall_m, s = south - wall_m, n = wall_m,
                  t = ceiling_m + wall_m;
  constexpr float cell = 2.0f * far_cell_m;
  add_part(model, "roof", panel({w, s, t}, {e - w, 0, 0}, {0, n - s, 0}, cell), plaster);
  add_part(model, "south face", panel({w, s, 0}, {e - w, 0, 0}, {0, 0, t}, cell), plaster);
  add_part(model, "north face", panel({e, n, 0}, {w - e, 0, 0}, {0, 0, t}, cell), plaster);
  add_part(model, "east face", panel({e, s, 0}, {0, n - s, 0}, {0, 0, t}, cell), plaster);
  add_window_wall(model, "west face", w, wall_m, cell);
}

void add_window(scene::Model& model) {
  constexpr float depth = wall_m, bar = 0.05f, thin = 0.03f;
  const float s = window_south_m, n = window_north_m, f = window_foot_m, t = window_top_m, out = west - depth;
  const auto box = [&](float y0, float y1, float z0, float z1, float x0, float x1) {
    add_box(model, "window frame", {x0, y0, z0}, {x1, y1, z1}, frame);
  };
  // The reveal, from within.
  add_part(model, "reveal", panel({out, s, f}, {0, n - s, 0}, {depth, 0, 0}, cell_m), plaster);
  add_part(model, "reveal", panel({west, s, t}, {0, n - s, 0}, {-depth, 0, 0}, cell_m), plaster);
  add_part(model, "reveal", panel({west, s, f}, {-depth, 0, 0}, {0, 0, t - f}, cell_m), plaster);
  add_part(model, "reveal", panel({out, n, f}, {depth, 0, 0}, {0, 0, t - f}, cell_m), plaster);
  const float x0 = out + 0.02f, x1 = out + 0.06f, middle = 0.5f * (s + n), across = f + 0.68f * (t - f);
  box(s, n, f, f + bar, x0, x1), box(s, n, t - bar, t, x0, x1);
  box(s, s + bar, f, t, x0, x1), box(n - bar, n, f, t, x0, x1);
  box(middle - bar, middle + bar, f, t, x0, x1), box(s, n, across - thin, across + thin, x0, x1);
  box(s - 0.06f, n + 0.06f, f - 0.03f, f, out, west + 0.06f);  // the sill
  add_part(model, "view", panel({west - 2.6f, -6.6f, -2.0f}, {0, 11.0f, 0}, {0, 0, 7.5f}, far_cell_m * 20.0f),
           view);
  // Once over the whole picture.
  for (glm::vec2& uv : model.parts.back().mesh.uvs) uv = {uv.x / 11.0f, 1.0f + uv.y / 7.5f};
}

/// A front with a raised field and a knob, its foot's left corner as seen from the room.
void add_front(scene::Model& model, glm::vec3 corner, float width, float height, bool knob_is_high) {
  constexpr float gap = 0.004f, rail = 0.055f, thick = 0.02f, set_back = 0.008f;
  const glm::vec3 low = corner + glm::vec3(gap, -thick, gap),
                  high = corner + glm::vec3(width - gap, 0, height - gap);
  add_box(model, "front", {low.x, low.y, low.z}, {low.x + rail, high.y, high.z}, front);
  add_box(model, "front", {high.x - rail, low.y, low.z}, high, front);
  add_box(model, "front", {low.x + rail, low.y, low.z}, {high.x - rail, high.y, low.z + rail}, front);
  add_box(model, "front", {low.x + rail, low.y, high.z - rail}, {high.x - rail, high.y, high.z}, front);
  add_box(model, "front", {low.x + rail, low.y + set_back, low.z + rail},
          {high.x - rail, high.y, high.z - rail}, front);
  Mesh knob;
  const float z = knob_is_high ? high.z - 0.09f : low.z + 0.09f;
  append(
      knob, turned(smooth({{0.004f, 0}, {0.005f, 0.012f}, {0.013f, 0.018f}, {0.0f, 0.026f}}, 4), 16),
      glm::rotate(glm::translate(glm::mat4(1.0f), {high.x - 0.5f * rail, low.y, z}), 1.5707963f, {1, 0, 0}));
  add_part(model, "knob", std::move(knob), china);
}

void add_cupboards(scene::Model& model) {
  constexpr float plinth = 0.1f, under = worktop_height_m - 0.04f, depth = -0.6f, unit = 0.6f;
  add_box(model, "base", {west, depth, plinth}, {east, -0.01f, under}, front, far_cell_m);
  add_box(model, "plinth", {west, depth + 0.05f, 0}, {east, -0.01f, plinth}, black, far_cell_m);
  for (int i = 0; i < 6; ++i) {
    const float x = west + unit * float(i);
    add_front(model, {x, depth, plinth}, unit, 0.54f, true);
    add_front(model, {x, depth, plinth + 0.54f}, unit, under - plinth - 0.54f, true);
  }
  constexpr float foot = worktop_height_m + tiled_m[1], head = 2.25f, upper = -0.33f;
  add_box(model, "wall cupboard", {east - 2.0f * unit, upper, foot}, {east, -0.01f, head}, front,
          near_cell_m * 2.0f);
  for (int i = 0; i < 2; ++i)
    add_front(model, {east - float(2 - i) * unit, upper, foot}, unit, head - foot, false);
}

/// The part of a mesh that does not lie within a box.
Mesh outside(Mesh mesh, const Bounds& box) {
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::uint32_t* corner = &mesh.indices[i];
    const auto is_within = [&](std::uint32_t v) {
      return glm::clamp(mesh.positions[v], box.min, box.max) == mesh.positions[v];
    };
    if (!std::all_of(corner, corner + 3, is_within)) kept.insert(kept.end(), corner, corner + 3);
  }
  mesh.indices = std::move(kept);
  return mesh;
}

/// Adds the worktop with an opening for the hob: two layers that all but touch would show through one another
/// in mirrors.
void add_worktop(scene::Model& model) {
  constexpr float thick = 0.04f, high = worktop_height_m;
  const Bounds hob_box{{hob_x_m - 0.29f, -0.56f, high - 0.01f}, {hob_x_m + 0.29f, -0.07f, hob_height_m}};
  add_part(model, "worktop",
           outside(panel({west, worktop_front_m, high}, {worktop_m[0], 0, 0}, {0, worktop_m[1], 0},
                         nearest_cell_m),
                   hob_box),
           worktop);
  add_part(model, "worktop edge",
           panel({west, worktop_front_m, high - thick}, {worktop_m[0], 0, 0}, {0, 0, thick}, near_cell_m),
           worktop);
  add_part(
      model, "worktop below",
      panel({west, -0.6f, high - thick}, {worktop_m[0], 0, 0}, {0, worktop_front_m + 0.6f, 0}, far_cell_m),
      worktop);
  add_box(model, "hob", hob_box.min, hob_box.max, hob, nearest_cell_m);
}

void add_shelf(scene::Model& model) {
  constexpr float from = -1.3f, to = 0.36f, depth = -0.2f;
  add_box(model, "shelf", {from, depth, shelf_height_m - 0.025f}, {to, -0.006f, shelf_height_m}, wood,
          near_cell_m);
  for (const float x : {from + 0.12f, to - 0.14f})
    add_box(model, "bracket", {x, depth + 0.03f, shelf_height_m - 0.06f},
            {x + 0.02f, -0.006f, shelf_height_m - 0.025f}, black);
}

}  // namespace

void add_room(scene::Model& model) {
  add_shell(model);
  add_outside(model);
  add_window(model);
  add_cupboards(model);
  add_worktop(model);
  add_shelf(model);
  add_box(model, "table", {-0.5f, -2.75f, 0.71f}, {0.7f, -2.05f, 0.75f}, wood, 0.1f);
  for (const float x : {-0.45f, 0.59f})
    for (const float y : {-2.7f, -2.16f})
      add_box(model, "leg", {x, y, 0}, {x + 0.06f, y + 0.06f, 0.71f}, wood, 0.2f);
}

}  // namespace parvis::kitchen
