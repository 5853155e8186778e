#include "places/paper_city/street_furniture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "places/paper_city/street_plan.h"
#include "synthesis/ground_texture.h"
#include "synthesis/trim_texture.h"

namespace parvis::city {
namespace {

constexpr std::size_t lamp_triangles = 24, bollard_triangles = 10;

/// A straight tapered tube with `sides` flat sides.
void add_tube(CityMesh& mesh, synthesis::Trim surface, glm::vec3 foot, int sides, float foot_radius,
              float top_radius, float height) {
  const glm::vec2 v = synthesis::trim_strip(surface);
  const auto rim = [&](int i, float radius, float z) {
    const float angle = 6.2831853f * (float(i) + 0.5f) / float(sides);
    return foot + glm::vec3(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  for (int i = 0; i < sides; ++i)
    mesh.quad(CityMaterial::trim, rim(i, foot_radius, 0), rim(i + 1, foot_radius, 0),
              rim(i + 1, top_radius, height), rim(i, top_radius, height), {0.0f, v.x}, {0.05f, v.y});
}

void add_lamp(CityMesh& mesh, glm::vec3 foot) {
  add_tube(mesh, synthesis::Trim::metal, foot, 4, 0.09f, 0.05f, 4.2f);
  add_tube(mesh, synthesis::Trim::slab, foot + glm::vec3(0, 0, 4.2f), 4, 0.1f, 0.22f, 0.5f);
  add_tube(mesh, synthesis::Trim::metal, foot + glm::vec3(0, 0, 4.7f), 4, 0.26f, 0.03f, 0.3f);
}

void add_bollard(CityMesh& mesh, glm::vec3 foot) {
  add_tube(mesh, synthesis::Trim::metal, foot, 4, 0.09f, 0.07f, 0.95f);
  const glm::vec2 v = synthesis::trim_strip(synthesis::Trim::metal);
  const float r = 0.05f, z = 0.95f;
  mesh.quad(CityMaterial::trim, foot + glm::vec3(-r, -r, z), foot + glm::vec3(r, -r, z),
            foot + glm::vec3(r, r, z), foot + glm::vec3(-r, r, z), {0.0f, v.x}, {0.02f, v.y});
}

void add_pit(CityMesh& mesh, glm::vec3 foot) {
  const glm::vec3 lift(0, 0, 0.03f), x(0.9f, 0, 0), y(0, 0.9f, 0);
  mesh.quad(CityMaterial::gravel, foot + lift - x - y, foot + lift + x - y, foot + lift + x + y,
            foot + lift - x + y, {0.0f, 0.35f}, {0.35f, 0.0f});
}

/// Lamps stand along both pavements of the two wide roads, outward from the main crossing, 25 m apart and
/// staggered.
glm::vec3 lamp_place(std::size_t i) {
  const glm::vec2 centre = main_crossing();
  const std::size_t ring = i / 8;
  const float reach = 17.0f + 25.0f * float(ring) + (i % 2 == 0 ? 0.0f : 12.5f);
  const float kerb = 0.5f * wide_road.carriageway_m + 0.45f, side = i % 2 == 0 ? kerb : -kerb;
  const float along = i / 4 % 2 == 0 ? reach : -reach;
  const glm::vec2 offset = i / 2 % 2 == 0 ? glm::vec2(side, along) : glm::vec2(along, side);
  return {centre + offset, kerb_m};
}

/// Bollards stand on the rounded corners of the main crossing.
glm::vec3 bollard_place(std::size_t i) {
  const glm::vec2 quadrant(i % 4 == 0 || i % 4 == 3 ? 1.0f : -1.0f, i % 4 < 2 ? 1.0f : -1.0f);
  const std::size_t number = i / 4;
  const float turn = 0.35f + 0.28f * float(number), half = 0.5f * wide_road.carriageway_m;
  const glm::vec2 from_kerb = glm::vec2(4.0f) - 3.6f * glm::vec2(std::sin(turn), std::cos(turn));
  return {main_crossing() + quadrant * (glm::vec2(half) + from_kerb), kerb_m};
}

}  // namespace

std::vector<TreePlace> tree_places() {
  const glm::vec2 c = main_crossing();
  const float bay = 0.5f * wide_road.carriageway_m - 1.1f;  // in the middle of the parking bays
  const std::array<glm::vec3, 8> feet{{{c.x + bay, c.y + 33.0f, 0.0f},
                                       {c.x - bay, c.y + 46.0f, 0.0f},
                                       {c.x + bay, c.y + 62.0f, 0.0f},
                                       {c.x - bay, c.y + 76.0f, 0.0f},
                                       {c.x + 19.0f, c.y - 20.0f, kerb_m},
                                       {c.x + 23.0f, c.y - 44.0f, kerb_m},
                                       {c.x + 47.0f, c.y - 23.0f, kerb_m},
                                       {c.x + 178.0f, c.y - 172.0f, kerb_m}}};
  std::vector<TreePlace> places;
  places.reserve(feet.size());
  for (std::size_t i = 0; i < feet.size(); ++i)
    places.push_back({feet[i], std::fmod(137.5f * float(i), 360.0f), i < 4 ? 0 : 1});
  return places;
}

std::vector<glm::vec3> street_lamp_places() {
  constexpr std::size_t maximum = 112;          // a reach of 342 m
  constexpr float clear_m = 1.5f;               // of the carriageways that cross
  const StreetPlan plan = make_street_plan(1);  // roads lie the same for all seeds
  std::vector<glm::vec3> places;
  for (std::size_t i = 0; i < maximum; ++i) {
    const glm::vec3 place = lamp_place(i);
    const auto stands_on = [&](const Road& road) {
      const float across = road.runs_north ? place.x : place.y;
      const bool crosses = road.profile.carriageway_m < wide_road.carriageway_m;
      return crosses && std::abs(across - road.offset_m) < 0.5f * road.profile.carriageway_m + clear_m;
    };
    if (std::ranges::none_of(plan.roads, stands_on)) places.push_back(place);
  }
  return places;
}

std::size_t furnished_lamps(std::size_t triangles) {
  triangles -= 2 * tree_places().size();
  // As many lamps as leave a number that bollards can fill.
  std::size_t lamps = triangles / lamp_triangles;
  while (lamps > 0 && (lamps > 12 || (triangles - lamps * lamp_triangles) % bollard_triangles != 0)) --lamps;
  return lamps;
}

void add_street_furniture(CityMesh& mesh, std::size_t triangles) {
  const std::size_t lamps = furnished_lamps(triangles);
  for (const TreePlace& tree : tree_places()) add_pit(mesh, tree.foot), triangles -= 2;
  assert(triangles % 2 == 0);
  const std::size_t bollards = (triangles - lamps * lamp_triangles) / bollard_triangles;
  for (std::size_t i = 0; i < lamps; ++i) add_lamp(mesh, lamp_place(i));
  for (std::size_t i = 0; i < bollards; ++i) add_bollard(mesh, bollard_place(i));
}

}  // namespace parvis::city
