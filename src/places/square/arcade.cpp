#include "places/square/arcade.h"

#include <array>
#include <cmath>
#include <numbers>

#include "synthesis/shop_texture.h"

namespace parvis::square {
namespace {

constexpr float half_pier_m = 0.62f, pier_depth_m = 0.85f, blind_depth_m = 0.4f;
constexpr float spring_m = 3.35f;  // where the arch begins
constexpr float ceiling_m = 5.35f;
constexpr float archivolt_m = 0.3f, archivolt_out_m = 0.07f;
constexpr int arch_pieces = 14;

/// Points of an arch from left to right, as (x, z).
std::array<glm::vec2, arch_pieces + 1> arch_points(float x0, float x1, float radius) {
  std::array<glm::vec2, arch_pieces + 1> points;
  const float middle = 0.5f * (x0 + x1);
  for (int i = 0; i <= arch_pieces; ++i) {
    const float angle = std::numbers::pi_v<float> * (1.0f - float(i) / float(arch_pieces));
    points[std::size_t(i)] = {middle + radius * std::cos(angle), spring_m + radius * std::sin(angle)};
  }
  return points;
}

/// The wall about an arch, at depth y, looking outward or into the gallery.
void add_arched_wall(ReliefMesh& mesh, Surface surface, float x0, float x1, float top, float y,
                     bool looks_in) {
  const auto quad = [&](float a, float b, float low_a, float low_b) {
    if (looks_in)
      mesh.quad(surface, {b, y, low_b}, {a, y, low_a}, {a, y, top}, {b, y, top});
    else
      mesh.quad(surface, {a, y, low_a}, {b, y, low_b}, {b, y, top}, {a, y, top});
  };
  const float left = x0 + half_pier_m, right = x1 - half_pier_m;
  if (looks_in) {
    quad(x0, left, 0.0f, 0.0f), quad(right, x1, 0.0f, 0.0f);
  } else {
    mesh.face(surface, x0, left, 0.0f, top, y), mesh.face(surface, right, x1, 0.0f, top, y);
  }
  const auto points = arch_points(x0, x1, 0.5f * (right - left));
  for (int i = 0; i < arch_pieces; ++i) {
    const glm::vec2 p = points[std::size_t(i)], q = points[std::size_t(i + 1)];
    quad(p.x, q.x, p.y, q.y);
  }
}

/// The inside of the arch and its jambs.
void add_intrados(ReliefMesh& mesh, float left, float right, float depth) {
  mesh.quad(Surface::ashlar, {left, 0, 0}, {left, depth, 0}, {left, depth, spring_m}, {left, 0, spring_m});
  mesh.quad(Surface::ashlar, {right, depth, 0}, {right, 0, 0}, {right, 0, spring_m},
            {right, depth, spring_m});
  const auto points = arch_points(left - half_pier_m, right + half_pier_m, 0.5f * (right - left));
  for (int i = 0; i < arch_pieces; ++i) {
    const glm::vec2 p = points[std::size_t(i)], q = points[std::size_t(i + 1)];
    mesh.quad(Surface::plaster, {p.x, 0, p.y}, {p.x, depth, p.y}, {q.x, depth, q.y}, {q.x, 0, q.y});
  }
}

/// A band that stands out along the arch.
void add_archivolt(ReliefMesh& mesh, float x0, float x1, float radius) {
  const auto inner = arch_points(x0, x1, radius), outer = arch_points(x0, x1, radius + archivolt_m);
  const float out = -archivolt_out_m;
  for (int i = 0; i < arch_pieces; ++i) {
    const glm::vec2 a = inner[std::size_t(i)], b = inner[std::size_t(i + 1)], c = outer[std::size_t(i + 1)],
                    d = outer[std::size_t(i)];
    mesh.quad(Surface::plaster, {a.x, out, a.y}, {b.x, out, b.y}, {c.x, out, c.y}, {d.x, out, d.y});
    mesh.quad(Surface::plaster, {d.x, out, d.y}, {c.x, out, c.y}, {c.x, 0, c.y}, {d.x, 0, d.y});
    mesh.quad(Surface::plaster, {a.x, 0, a.y}, {b.x, 0, b.y}, {b.x, out, b.y}, {a.x, out, a.y});
  }
}

void add_stones(ReliefMesh& mesh, float x0, float x1, float depth) {
  const float left = x0 + half_pier_m, right = x1 - half_pier_m, middle = 0.5f * (x0 + x1);
  const float radius = 0.5f * (right - left);
  constexpr float impost_m = 0.24f, out = 0.09f, plinth_m = 0.5f, plinth_out = 0.06f;
  for (const auto& [from, to] : {std::pair{x0, left + out}, std::pair{right - out, x1}})
    mesh.box(Surface::plaster, {from, -out, spring_m - impost_m}, {to, depth, spring_m});
  for (const auto& [from, to] : {std::pair{x0, left + plinth_out}, std::pair{right - plinth_out, x1}})
    mesh.box(Surface::ashlar, {from, -plinth_out, 0.0f}, {to, depth, plinth_m});
  mesh.box(Surface::plaster, {middle - 0.19f, -0.16f, spring_m + radius - 0.06f},
           {middle + 0.19f, 0.0f, spring_m + radius + 0.52f});
}

void add_shop(ReliefMesh& mesh, const FacadeStyle& style, float x0, float x1, float top, float y, int shop) {
  const glm::vec2 strip = synthesis::ground_floor_strip(style.shop_strip);
  const float u = float(shop) / float(synthesis::shop_modules), width = 1.0f / float(synthesis::shop_modules);
  mesh.picture(Surface::shops, x0, x1, 0.0f, top, y, {u, strip.x}, {u + width, strip.y});
}

/// Ceiling of the gallery, and a beam on brackets at the bay's left end.
void add_ceiling(ReliefMesh& mesh, float x0, float x1) {
  constexpr float near = pier_depth_m, far = gallery_m, half_beam = 0.3f;
  mesh.quad(Surface::plaster, {x0, far, ceiling_m}, {x1, far, ceiling_m}, {x1, near, ceiling_m},
            {x0, near, ceiling_m});
  constexpr int pieces = 8;
  const auto at = [&](int i) {
    const float t = float(i) / float(pieces);
    return glm::vec2(glm::mix(near, far, t),
                     ceiling_m - 0.25f - 0.9f * std::pow(std::abs(2.0f * t - 1.0f), 2.5f));
  };
  for (int i = 0; i < pieces; ++i) {
    const glm::vec2 p = at(i), q = at(i + 1);
    const float a = x0 - half_beam, b = x0 + half_beam, top = ceiling_m;
    mesh.quad(Surface::plaster, {a, q.x, q.y}, {b, q.x, q.y}, {b, p.x, p.y}, {a, p.x, p.y});
    mesh.quad(Surface::plaster, {b, p.x, p.y}, {b, q.x, q.y}, {b, q.x, top}, {b, p.x, top});
    mesh.quad(Surface::plaster, {a, q.x, q.y}, {a, p.x, p.y}, {a, p.x, top}, {a, q.x, top});
  }
}

}  // namespace

void add_arcade_bay(ReliefMesh& mesh, const FacadeStyle& style, float x0, float x1, int shop) {
  const bool is_open = style.ground == GroundFloor::arcade;
  const float left = x0 + half_pier_m, right = x1 - half_pier_m,
              depth = is_open ? pier_depth_m : blind_depth_m;
  mesh.set_colour(style.trim);
  add_arched_wall(mesh, Surface::ashlar, x0, x1, style.ground_m, 0.0f, false);
  add_intrados(mesh, left, right, depth);
  mesh.set_colour(style.trim * 1.06f);
  add_archivolt(mesh, x0, x1, 0.5f * (right - left));
  add_stones(mesh, x0, x1, depth);
  if (is_open) {
    mesh.set_colour(glm::mix(style.wall, glm::vec3(0.62f, 0.6f, 0.55f), 0.88f));
    add_arched_wall(mesh, Surface::plaster, x0, x1, ceiling_m, depth, true);
    add_ceiling(mesh, x0, x1);
  }
  mesh.set_colour(glm::vec3(sheet_albedo));
  add_shop(mesh, style, x0, x1, is_open ? ceiling_m : style.ground_m - 0.4f, is_open ? gallery_m : depth,
           shop);
}

void add_gallery_end(ReliefMesh& mesh, const FacadeStyle& style, float x, bool looks_right, bool is_open) {
  // The same wall as in the front, across the gallery.
  const Frame front = mesh.frame();
  Frame across = front;
  across.along = looks_right ? front.inward : -front.inward;
  across.inward = looks_right ? -front.along : front.along;
  across.origin = front.point(x, looks_right ? 0.0f : gallery_m, 0.0f);
  mesh.set_frame(across);
  mesh.set_colour(style.trim);
  if (is_open) {
    add_arched_wall(mesh, Surface::ashlar, 0.0f, gallery_m, style.ground_m, 0.0f, false);
    add_intrados(mesh, half_pier_m, gallery_m - half_pier_m, half_pier_m);
    mesh.set_colour(style.trim * 1.06f);
    add_archivolt(mesh, 0.0f, gallery_m, 0.5f * gallery_m - half_pier_m);
    add_stones(mesh, 0.0f, gallery_m, half_pier_m);
    add_arched_wall(mesh, Surface::plaster, 0.0f, gallery_m, ceiling_m, half_pier_m, true);
  } else {
    mesh.face(Surface::ashlar, 0.0f, gallery_m, 0.0f, style.ground_m);
  }
  mesh.set_frame(front);
}

}  // namespace parvis::square
