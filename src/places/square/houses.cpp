#include "places/square/houses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace parvis::square {
namespace {

constexpr float pitch = 0.44f;  // rise per metre of a roof of tiles
constexpr float eaves_out_m = 0.12f;

/// The facade on a side of a house, as seen from there.
Frame side_frame(const Building& house, bool is_right) {
  const Frame& f = house.frame;
  if (is_right) return {f.point(house.width_m, 0, 0), f.inward, -f.along};
  return {f.point(0, house.depth_m, 0), -f.inward, f.along};
}

/// A hipped roof where sides are free, gables between neighbours. The ridge runs along the front.
void add_roof(ReliefMesh& mesh, const Building& h) {
  const float z = h.style.eaves_m(), out = h.style.cornice_out_m + eaves_out_m;
  const float half = 0.5f * h.depth_m, rise = pitch * (half + out);
  const float x0 = h.has_left_front ? -out : 0.0f, x1 = h.width_m + (h.has_right_front ? out : 0.0f);
  const float r0 = h.has_left_front ? half : 0.0f, r1 = h.width_m - (h.has_right_front ? half : 0.0f);
  const glm::vec3 a(x0, -out, z), b(x1, -out, z), c(x1, h.depth_m + out, z), d(x0, h.depth_m + out, z);
  const glm::vec3 left(r0, half, z + rise), right(r1, half, z + rise);
  mesh.set_colour(glm::vec3(sheet_albedo));
  mesh.quad(Surface::tiles, a, b, right, left);
  mesh.quad(Surface::tiles, c, d, left, right);
  if (h.has_left_front)
    mesh.triangle(Surface::tiles, d, a, left);
  else
    mesh.set_colour(h.style.wall * 0.9f), mesh.triangle(Surface::plaster, d, a, left);
  mesh.set_colour(glm::vec3(sheet_albedo));
  if (h.has_right_front)
    mesh.triangle(Surface::tiles, b, c, right);
  else
    mesh.set_colour(h.style.wall * 0.9f), mesh.triangle(Surface::plaster, b, c, right);
}

/// Walls without openings, where no facade stands.
void add_blank_walls(ReliefMesh& mesh, const Building& h) {
  const float top = h.style.eaves_m();
  const Frame front = h.frame;
  mesh.set_colour(h.style.wall * 0.92f);
  for (const bool is_right : {false, true}) {
    if (is_right ? h.has_right_front : h.has_left_front) continue;
    mesh.set_frame(side_frame(h, is_right));
    // The gallery of a neighbour of the square stays open.
    const bool is_gallery = h.style.ground == GroundFloor::arcade;
    const float low = is_gallery ? h.style.ground_m : 0.0f;
    mesh.face(Surface::plaster, 0.0f, h.depth_m, low, top);
    if (is_gallery)
      mesh.face(Surface::plaster, is_right ? gallery_m : 0.0f, h.depth_m - (is_right ? 0.0f : gallery_m),
                0.0f, low);
  }
  mesh.set_frame({front.point(h.width_m, h.depth_m, 0), -front.along, -front.inward});
  mesh.face(Surface::plaster, 0.0f, h.width_m, 0.0f, top);
  mesh.set_frame(front);
}

/// The wall before which a gallery ends.
void close_gallery(ReliefMesh& mesh, const Building& h, bool is_right) {
  const float x = is_right ? h.width_m : 0.0f, top = h.style.ground_m, y0 = is_right ? gallery_m : 0.0f;
  mesh.set_colour(h.style.wall);
  mesh.quad(Surface::plaster, {x, y0, 0}, {x, gallery_m - y0, 0}, {x, gallery_m - y0, top}, {x, y0, top});
}

void add_chimney(ReliefMesh& mesh, const Building& h, Random& random) {
  const float x = random.uniform(0.15f, 0.85f) * h.width_m, y = random.uniform(0.35f, 0.65f) * h.depth_m;
  const float ridge = h.style.eaves_m() + pitch * 0.5f * h.depth_m;
  mesh.set_colour(h.style.wall * 0.85f);
  mesh.box(Surface::plaster, {x - 0.5f, y - 0.32f, ridge - 1.6f}, {x + 0.5f, y + 0.32f, ridge + 1.1f});
  mesh.quad(Surface::plaster, {x + 0.5f, y + 0.32f, ridge - 1.6f}, {x - 0.5f, y + 0.32f, ridge - 1.6f},
            {x - 0.5f, y + 0.32f, ridge + 1.1f}, {x + 0.5f, y + 0.32f, ridge + 1.1f});
  mesh.box(Surface::plaster, {x - 0.58f, y - 0.4f, ridge + 0.9f}, {x + 0.58f, y + 0.4f, ridge + 1.0f});
  mesh.set_colour(glm::vec3(0.4f, 0.16f, 0.08f));
  for (const float pot : {-0.28f, 0.02f, 0.3f})
    mesh.box(Surface::plaster, {x + pot - 0.1f, y - 0.1f, ridge + 1.1f},
             {x + pot + 0.1f, y + 0.1f, ridge + 1.5f});
}

/// A gabled window in the front slope.
void add_dormer(ReliefMesh& mesh, const Building& h, float x, int variant) {
  const float eaves = h.style.eaves_m(), out = h.style.cornice_out_m + eaves_out_m;
  const auto depth_at = [&](float z) { return (z - eaves) / pitch - out; };
  const float low = eaves + 0.55f, high = low + 1.25f, peak = high + 0.38f, half = 0.6f;
  const float y = depth_at(low), back_high = depth_at(high), back_peak = depth_at(peak);
  const float u = float(variant) / float(window_variants), du = 1.0f / float(window_variants);
  mesh.set_colour(glm::vec3(sheet_albedo));
  mesh.picture(Surface::window, x - half + 0.1f, x + half - 0.1f, low, high, y - 0.01f, {u, 0.7f},
               {u + du, 0.02f});
  mesh.set_colour(h.style.trim);
  mesh.face(Surface::plaster, x - half, x + half, low, high, y);
  mesh.triangle(Surface::plaster, {x - half, y, high}, {x + half, y, high}, {x, y, peak});
  mesh.triangle(Surface::plaster, {x - half, y, low}, {x - half, y, high}, {x - half, back_high, high});
  mesh.triangle(Surface::plaster, {x + half, y, high}, {x + half, y, low}, {x + half, back_high, high});
  mesh.set_colour(glm::vec3(sheet_albedo));
  const float over = half + 0.12f, front = y - 0.15f, edge = high - 0.07f;
  mesh.quad(Surface::tiles, {x - over, front, edge}, {x, front, peak}, {x, back_peak, peak},
            {x - over, back_high, edge});
  mesh.quad(Surface::tiles, {x, front, peak}, {x + over, front, edge}, {x + over, back_high, edge},
            {x, back_peak, peak});
}

}  // namespace

void add_houses(ReliefMesh& mesh, const std::vector<Building>& houses, std::uint64_t seed) {
  int number = 0;
  for (const Building& house : houses) {
    Random random(seed, std::uint64_t(100 + number));
    mesh.begin_group(fmt::format("house {}", ++number), house.frame);
    const bool is_arcade = house.style.ground == GroundFloor::arcade;
    add_facade(mesh, house.style, house.width_m, house.bays, is_arcade && house.has_left_front,
               is_arcade && house.has_right_front, random);
    for (const bool is_right : {false, true}) {
      if (!(is_right ? house.has_right_front : house.has_left_front)) continue;
      mesh.set_frame(side_frame(house, is_right));
      FacadeStyle side = house.style;
      // The gallery's own end stands where the first metres of the side would be.
      const float from = is_arcade ? gallery_m : 0.0f;
      if (is_arcade) side.ground = GroundFloor::blind_arcade;
      const int bays = std::max(2, int(std::lround(house.depth_m / 3.6f)));
      add_side_facade(mesh, side, house.depth_m, bays, is_right ? from : 0.0f,
                      is_right ? house.depth_m : house.depth_m - from, random);
      mesh.set_frame(house.frame);
    }
    if (house.closes_left) close_gallery(mesh, house, false);
    if (house.closes_right) close_gallery(mesh, house, true);
    add_blank_walls(mesh, house);
    add_roof(mesh, house);
    if (random.chance(0.8f)) add_chimney(mesh, house, random);
    if (house.is_on_square ? false : random.chance(0.5f))
      for (int bay = 0; bay < house.bays; bay += 2)
        add_dormer(mesh, house, house.width_m * (float(bay) + 0.5f) / float(house.bays),
                   random.index(window_variants));
  }
}

}  // namespace parvis::square
