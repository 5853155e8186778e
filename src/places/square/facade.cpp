#include "places/square/facade.h"

#include <algorithm>
#include <cmath>

#include "places/square/arcade.h"
#include "synthesis/round_mesh.h"
#include "synthesis/shop_texture.h"
#include "synthesis/trim_texture.h"

namespace parvis::square {
namespace {

constexpr float reveal_m = 0.22f, surround_m = 0.17f, surround_out_m = 0.05f;
constexpr float course_m = 0.3f;  // a string course at the foot of each floor

/// A window's opening in the wall.
struct Opening {
  float x0, x1, z0, z1;
  float middle() const { return 0.5f * (x0 + x1); }
};

void add_wall_about(ReliefMesh& mesh, float x0, float x1, float z0, float z1, const Opening& o) {
  mesh.face(Surface::plaster, x0, o.x0, z0, z1), mesh.face(Surface::plaster, o.x1, x1, z0, z1);
  mesh.face(Surface::plaster, o.x0, o.x1, z0, o.z0), mesh.face(Surface::plaster, o.x0, o.x1, o.z1, z1);
}

void add_glass(ReliefMesh& mesh, const Opening& o, Random& random) {
  const float u = float(random.index(window_variants)) / float(window_variants),
              margin = 0.004f / float(window_variants);
  mesh.set_colour(glm::vec3(sheet_albedo));
  mesh.picture(Surface::window, o.x0, o.x1, o.z0, o.z1, reveal_m, {u + margin, 0.995f},
               {u + 1.0f / float(window_variants) - margin, 0.005f});
}

void add_reveal(ReliefMesh& mesh, const Opening& o) {
  const float in = reveal_m;
  mesh.quad(Surface::plaster, {o.x0, 0, o.z0}, {o.x0, in, o.z0}, {o.x0, in, o.z1}, {o.x0, 0, o.z1});
  mesh.quad(Surface::plaster, {o.x1, in, o.z0}, {o.x1, 0, o.z0}, {o.x1, 0, o.z1}, {o.x1, in, o.z1});
  mesh.quad(Surface::plaster, {o.x0, in, o.z1}, {o.x1, in, o.z1}, {o.x1, 0, o.z1}, {o.x0, 0, o.z1});
  mesh.quad(Surface::plaster, {o.x0, 0, o.z0}, {o.x1, 0, o.z0}, {o.x1, in, o.z0}, {o.x0, in, o.z0});
}

void add_surround(ReliefMesh& mesh, const Opening& o) {
  const float out = -surround_out_m, w = surround_m;
  mesh.box(Surface::plaster, {o.x0 - w, out, o.z0}, {o.x0, 0, o.z1 + w});
  mesh.box(Surface::plaster, {o.x1, out, o.z0}, {o.x1 + w, 0, o.z1 + w});
  mesh.box(Surface::plaster, {o.x0, out, o.z1}, {o.x1, 0, o.z1 + w});
  mesh.box(Surface::plaster, {o.x0 - w - 0.06f, -0.15f, o.z0 - 0.13f}, {o.x1 + w + 0.06f, 0, o.z0});
}

/// A moulding above a window: a ledge, and a pediment on it.
void add_hood(ReliefMesh& mesh, const Opening& o, bool has_pediment, bool is_round) {
  const float x0 = o.x0 - surround_m - 0.14f, x1 = o.x1 + surround_m + 0.14f, z = o.z1 + surround_m + 0.1f;
  const glm::vec2 profile[] = {{0.0f, 0.0f},   {0.07f, 0.02f}, {0.1f, 0.1f},
                               {0.22f, 0.13f}, {0.24f, 0.2f},  {0.0f, 0.24f}};
  mesh.moulding(Surface::plaster, x0, x1, z, profile);
  for (const float x : {o.x0 - surround_m, o.x1 + 0.02f})
    mesh.box(Surface::plaster, {x, -0.14f, z - 0.24f}, {x + surround_m - 0.02f, 0, z});
  if (!has_pediment) return;
  const float foot = z + 0.22f, rise = 0.46f, out = 0.2f, middle = o.middle();
  const int pieces = is_round ? 8 : 2;
  const auto at = [&](int i) {
    const float t = 2.0f * float(i) / float(pieces) - 1.0f;
    return glm::vec2(glm::mix(x0, x1, 0.5f * (t + 1.0f)),
                     foot + rise * (is_round ? std::sqrt(std::max(1.0f - t * t, 0.0f)) * 0.9f + 0.02f
                                             : 1.0f - std::abs(t) + 0.02f));
  };
  for (int i = 0; i < pieces; ++i) {
    const glm::vec2 p = at(i), q = at(i + 1);
    const glm::vec2 p_in(glm::mix(middle, p.x, 0.86f), glm::mix(foot, p.y, 0.74f)),
        q_in(glm::mix(middle, q.x, 0.86f), glm::mix(foot, q.y, 0.74f));
    mesh.quad(Surface::plaster, {p.x, -out, p.y}, {q.x, -out, q.y}, {q.x, 0, q.y}, {p.x, 0, p.y});
    mesh.quad(Surface::plaster, {p_in.x, -out, p_in.y}, {q_in.x, -out, q_in.y}, {q.x, -out, q.y},
              {p.x, -out, p.y});
    mesh.quad(Surface::plaster, {p_in.x, -0.06f, p_in.y}, {q_in.x, -0.06f, q_in.y}, {q_in.x, -out, q_in.y},
              {p_in.x, -out, p_in.y});
    mesh.quad(Surface::plaster, {p_in.x, -0.06f, foot}, {q_in.x, -0.06f, foot}, {q_in.x, -0.06f, q_in.y},
              {p_in.x, -0.06f, p_in.y});
  }
}

/// One leaf, hinged at (x, y): 0 shuts it, pi folds it back onto the wall. `side` is -1 for the left leaf.
void add_leaf(ReliefMesh& mesh, float x, float y, float side, float width, float z0, float z1, float angle) {
  const glm::vec3 along(-side * std::cos(angle), -std::sin(angle), 0.0f);                // from the hinge
  const glm::vec3 out = side * glm::vec3(along.y, -along.x, 0.0f), thick = 0.04f * out;  // shut: outward
  const glm::vec3 a(x, y, z0), b = a + width * along, up(0, 0, z1 - z0);
  const auto side_quad = [&](glm::vec3 p, glm::vec3 q, bool is_front) {
    const bool turns = glm::dot(glm::cross(q - p, up), is_front ? out : -out) < 0.0f;
    if (turns) std::swap(p, q);
    mesh.quad(Surface::shutter, {p, q, q + up, p + up},
              {{0.0f, 1.0f}, {1.0f, 1.0f}, {1.0f, 0.0f}, {0.0f, 0.0f}});
  };
  side_quad(a + thick, b + thick, true), side_quad(a, b, false);
  const glm::vec3 edge[4] = {b, b + thick, b + thick + up, b + up};
  const bool turns = glm::dot(glm::cross(edge[1] - edge[0], up), along) < 0.0f;
  const glm::vec2 uvs[4] = {{0.02f, 1.0f}, {0.08f, 1.0f}, {0.08f, 0.0f}, {0.02f, 0.0f}};
  if (turns)
    mesh.quad(Surface::shutter, {edge[1], edge[0], edge[3], edge[2]}, {uvs[0], uvs[1], uvs[2], uvs[3]});
  else
    mesh.quad(Surface::shutter, {edge[0], edge[1], edge[2], edge[3]}, {uvs[0], uvs[1], uvs[2], uvs[3]});
}

void add_shutters(ReliefMesh& mesh, const Opening& o, bool is_plain, Random& random) {
  const float width = 0.5f * (o.x1 - o.x0), shut = random.uniform();
  for (const float side : {-1.0f, 1.0f}) {
    const float x = side < 0.0f ? o.x0 : o.x1;
    const float angle = shut < 0.1f ? 0.0f : shut < 0.24f ? random.uniform(0.4f, 1.9f) : 3.14159265f;
    if (angle == 0.0f)
      add_leaf(mesh, x, 0.1f, side, width, o.z0, o.z1, 0.0f);
    else
      add_leaf(mesh, x, is_plain ? -0.02f : -surround_out_m - 0.02f, side, width, o.z0, o.z1, angle);
  }
}

/// A slab on brackets with a railing.
void add_balcony(ReliefMesh& mesh, float x0, float x1, float z, float out) {
  const glm::vec2 profile[] = {{0.0f, -0.2f}, {out - 0.14f, -0.2f}, {out - 0.1f, -0.12f},
                               {out, -0.1f},  {out, 0.0f},          {0.0f, 0.0f}};
  mesh.moulding(Surface::plaster, x0, x1, z, profile);
  const int brackets = std::max(2, int(std::lround((x1 - x0) / 1.4f)) + 1);
  for (int i = 0; i < brackets; ++i) {
    const float x = glm::mix(x0 + 0.15f, x1 - 0.37f, float(i) / float(brackets - 1));
    const glm::vec2 scroll[] = {{0.0f, -0.75f}, {0.12f, -0.7f},        {0.16f, -0.5f},
                                {0.3f, -0.38f}, {0.72f * out, -0.32f}, {0.74f * out, -0.2f}};
    mesh.moulding(Surface::plaster, x, x + 0.22f, z, scroll);
  }
  const float rail = -out + 0.07f, left = x0 + 0.06f, right = x1 - 0.06f, height = 1.0f;
  const auto railing = [&](glm::vec3 a, glm::vec3 b) {
    const float length = glm::length(b - a);
    const glm::vec3 up(0, 0, height);
    mesh.quad(Surface::railing, {a, b, b + up, a + up},
              {{0.0f, 1.0f}, {length, 1.0f}, {length, 0.0f}, {0.0f, 0.0f}});
  };
  railing({left, rail, z}, {right, rail, z}), railing({left, 0, z}, {left, rail, z}),
      railing({right, rail, z}, {right, 0, z});
  mesh.box(Surface::iron, {left - 0.03f, rail - 0.03f, z + height - 0.03f},
           {right + 0.03f, rail + 0.03f, z + height + 0.02f});
  for (const float x : {left - 0.03f, right - 0.03f})
    mesh.box(Surface::iron, {x, rail, z + height - 0.03f}, {x + 0.06f, 0.0f, z + height + 0.02f});
}

struct Floor {
  int index;        ///< 0: the first above the ground floor
  float foot, top;  ///< heights
  bool is_last;
};

void add_window_bay(ReliefMesh& mesh, const FacadeStyle& style, const Floor& floor, float x0, float x1,
                    bool has_balcony, int bay, Random& random) {
  const float storey = floor.top - floor.foot, middle = 0.5f * (x0 + x1), half = 0.58f;
  const bool is_french = has_balcony || (floor.index == 0 && style.has_pediments);
  const float foot = floor.foot + (is_french ? course_m + 0.02f : 0.95f),
              head = std::min(foot + (is_french       ? 2.45f
                                      : floor.is_last ? 1.65f
                                                      : 2.0f),
                              floor.top - 0.5f);
  const Opening o{middle - half, middle + half, foot, head};
  const bool is_plain = style.detail == FacadeDetail::plain;
  mesh.set_colour(style.wall);
  add_wall_about(mesh, x0, x1, floor.foot, floor.top, o);
  mesh.set_colour(glm::mix(style.wall, style.trim, 0.5f));
  add_reveal(mesh, o);
  add_glass(mesh, o, random);
  mesh.set_colour(style.trim);
  if (!is_plain) {
    add_surround(mesh, o);
    if (storey > 3.2f && !floor.is_last)
      add_hood(mesh, o, style.has_pediments && floor.index == 0, bay % 2 == 1);
  }
  if (has_balcony) {
    mesh.set_colour(style.trim);
    add_balcony(mesh, middle - 1.35f, middle + 1.35f, foot, floor.index == 0 ? 0.95f : 0.6f);
  }
  mesh.set_colour(style.shutter * random.uniform(0.8f, 1.15f));
  add_shutters(mesh, o, is_plain, random);
}

void add_cornice(ReliefMesh& mesh, const FacadeStyle& style, float width_m, float z) {
  const float out = style.cornice_out_m;
  mesh.set_colour(style.trim * 1.04f);
  const glm::vec2 profile[] = {{0.0f, 0.0f},         {0.06f, 0.0f}, {0.08f, 0.16f},       {0.03f, 0.18f},
                               {0.03f, 0.42f},       {0.1f, 0.46f}, {0.14f, 0.56f},       {out - 0.1f, 0.6f},
                               {out - 0.04f, 0.72f}, {out, 0.78f},  {out + 0.04f, 0.92f}, {0.0f, cornice_m}};
  mesh.moulding(Surface::plaster, 0.0f, width_m, z, profile);
  if (style.detail == FacadeDetail::plain) return;
  const int modillions = std::max(2, int(std::lround(width_m / 0.62f)));
  for (int i = 0; i < modillions; ++i) {
    const float x = width_m * (float(i) + 0.5f) / float(modillions);
    mesh.box(Surface::plaster, {x - 0.1f, 0.14f - out, z + 0.44f}, {x + 0.1f, -0.05f, z + 0.6f});
  }
}

void add_courses(ReliefMesh& mesh, const FacadeStyle& style, float width_m) {
  const glm::vec2 profile[] = {{0.0f, 0.0f},   {0.05f, 0.0f},  {0.06f, 0.14f},
                               {0.14f, 0.18f}, {0.16f, 0.26f}, {0.0f, course_m}};
  const glm::vec2 strong[] = {{0.0f, -0.3f}, {0.08f, -0.28f}, {0.1f, -0.05f},  {0.24f, 0.04f},
                              {0.3f, 0.2f},  {0.32f, 0.26f},  {0.0f, course_m}};
  float z = style.ground_m;
  mesh.set_colour(style.trim);
  for (std::size_t i = 0; i < style.floors_m.size(); ++i) {
    if (i == 0)
      mesh.moulding(Surface::plaster, 0.0f, width_m, z, strong);
    else if (style.detail == FacadeDetail::whole)
      mesh.moulding(Surface::plaster, 0.0f, width_m, z, profile);
    z += style.floors_m[i];
  }
}

/// Stones at the corners of a house, of two lengths in turn.
void add_quoins(ReliefMesh& mesh, const FacadeStyle& style, float width_m) {
  constexpr float stone_m = 0.42f;
  mesh.set_colour(style.trim);
  const float from = style.ground_m + course_m, to = style.eaves_m() - cornice_m;
  const int count = int((to - from) / stone_m);
  for (int i = 0; i < count; ++i) {
    const float z = from + stone_m * float(i), length = i % 2 == 0 ? 0.62f : 0.42f;
    mesh.box(Surface::plaster, {0.0f, -0.035f, z + 0.01f}, {length, 0.0f, z + stone_m - 0.01f});
    mesh.box(Surface::plaster, {width_m - length, -0.035f, z + 0.01f}, {width_m, 0.0f, z + stone_m - 0.01f});
  }
}

/// Cloth over the shops of a flat ground floor.
void add_awning(ReliefMesh& mesh, float x0, float x1, bool is_red) {
  const glm::vec2 v =
      synthesis::trim_strip(is_red ? synthesis::Trim::awning_red : synthesis::Trim::awning_green);
  const float u = (x1 - x0) / synthesis::trim_sheet_m, hem = glm::mix(v.x, v.y, 0.2f);
  constexpr float out = -1.5f, low = 2.7f, high = 3.3f;
  mesh.set_colour(glm::vec3(sheet_albedo));
  mesh.quad(Surface::cloth, {{x0, out, low}, {x1, out, low}, {x1, -0.02f, high}, {x0, -0.02f, high}},
            {{0, hem}, {u, hem}, {u, v.y}, {0, v.y}});
  mesh.quad(Surface::cloth, {{x0, out, low - 0.2f}, {x1, out, low - 0.2f}, {x1, out, low}, {x0, out, low}},
            {{0, v.x}, {u, v.x}, {u, hem}, {0, hem}});
}

void add_shop_front(ReliefMesh& mesh, const FacadeStyle& style, float width_m, Random& random) {
  const int shops = std::max(1, int(std::lround(width_m / synthesis::shop_module_m)));
  const glm::vec2 strip = synthesis::ground_floor_strip(style.shop_strip);
  const int first = random.index(synthesis::shop_modules);
  for (int i = 0; i < shops; ++i) {
    const float x0 = width_m * float(i) / float(shops), x1 = width_m * float(i + 1) / float(shops);
    const float u = float((first + i) % synthesis::shop_modules) / float(synthesis::shop_modules);
    mesh.set_colour(glm::vec3(sheet_albedo));
    mesh.picture(Surface::shops, x0, x1, 0.0f, style.ground_m, 0.0f, {u, strip.x},
                 {u + 1.0f / float(synthesis::shop_modules), strip.y});
    if (style.shop_strip != synthesis::house_strip && random.chance(0.55f))
      add_awning(mesh, x0 + 0.3f, x1 - 0.3f, random.chance(0.5f));
  }
}

/// Everything above the ground floor.
void add_storeys(ReliefMesh& mesh, const FacadeStyle& style, float width_m, int bays, Random& random) {
  const float bay_m = width_m / float(bays);
  float foot = style.ground_m;
  for (std::size_t i = 0; i < style.floors_m.size(); ++i) {
    const Floor floor{int(i), foot, foot + style.floors_m[i], i + 1 == style.floors_m.size()};
    for (int bay = 0; bay < bays; ++bay) {
      const bool has_balcony = i < 2 && random.chance(i == 0 ? style.balconies : 0.3f * style.balconies);
      add_window_bay(mesh, style, floor, bay_m * float(bay), bay_m * float(bay + 1), has_balcony, bay,
                     random);
    }
    foot = floor.top;
  }
  add_courses(mesh, style, width_m);
  if (style.detail == FacadeDetail::whole) add_quoins(mesh, style, width_m);
  add_cornice(mesh, style, width_m, foot);
}

}  // namespace

float FacadeStyle::eaves_m() const {
  float z = ground_m + cornice_m;
  for (const float storey : floors_m) z += storey;
  return z;
}

void add_facade(ReliefMesh& mesh, const FacadeStyle& style, float width_m, int bays, bool open_left,
                bool open_right, Random& random) {
  const float bay_m = width_m / float(bays);
  if (style.ground == GroundFloor::shops) add_shop_front(mesh, style, width_m, random);
  if (style.ground == GroundFloor::arcade) {
    for (int bay = 0; bay < bays; ++bay)
      add_arcade_bay(mesh, style, bay_m * float(bay), bay_m * float(bay + 1),
                     (bay + style.shop_strip) % synthesis::shop_modules);
    if (open_left) add_gallery_end(mesh, style, 0.0f, false, true);
    if (open_right) add_gallery_end(mesh, style, width_m, true, true);
  }
  add_storeys(mesh, style, width_m, bays, random);
}

void add_side_facade(ReliefMesh& mesh, const FacadeStyle& style, float width_m, int bays, float from_m,
                     float to_m, Random& random) {
  if (style.ground == GroundFloor::shops) {
    add_shop_front(mesh, style, width_m, random);
  } else {
    const int arches = std::max(1, int(std::lround((to_m - from_m) / 4.0f)));
    const float bay_m = (to_m - from_m) / float(arches);
    for (int bay = 0; bay < arches; ++bay)
      add_arcade_bay(mesh, style, from_m + bay_m * float(bay), from_m + bay_m * float(bay + 1),
                     (bay + style.shop_strip + 2) % synthesis::shop_modules);
  }
  add_storeys(mesh, style, width_m, bays, random);
}

}  // namespace parvis::square
