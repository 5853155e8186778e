#include "places/square/square.h"

#include <gtest/gtest.h>

#include <cmath>

#include "places/square/fountain.h"
#include "places/square/layout.h"
#include "places/square/relief_mesh.h"
#include "places/square/square_ground.h"

namespace parvis::square {
namespace {

/// Corners of a house in plan.
std::array<glm::vec2, 4> corners(const Building& h) {
  const auto at = [&](float x, float y) { return glm::vec2(h.frame.point(x, y, 0)); };
  return {at(0, 0), at(h.width_m, 0), at(h.width_m, h.depth_m), at(0, h.depth_m)};
}

bool overlaps(const Building& house, glm::vec2 low, glm::vec2 high) {
  glm::vec2 min(1e9f), max(-1e9f);
  for (const glm::vec2 p : corners(house)) min = glm::min(min, p), max = glm::max(max, p);
  return min.x < high.x && max.x > low.x && min.y < high.y && max.y > low.y;
}

TEST(Square, HousesLeaveTheSquareAndItsStreetsFree) {
  for (const Building& house : plan_houses(1)) {
    const float out = reach_m - 14.0f, d = 0.05f;
    const std::pair<glm::vec2, glm::vec2> free[] = {
        {{west_m, avenue_north_line_m}, {street_west_line_m, north_m}},
        {{-out, south_m}, {out, avenue_north_line_m}},
        {{street_west_line_m, avenue_north_line_m}, {east_m, out}},
        {{lane_x - lane_half_m, -out}, {lane_x + lane_half_m, south_m}},
        {{-out, tram_y - tram_half_m}, {west_m, tram_y + tram_half_m}},
        {{tram_x - tram_half_m, north_m}, {tram_x + tram_half_m, 120.0f}}};
    for (const auto& [low, high] : free)
      EXPECT_FALSE(overlaps(house, low + d, high - d)) << house.frame.origin.x << " " << house.frame.origin.y;
  }
}

TEST(Square, FacadesLookOntoTheirStreets) {
  int on_square = 0;
  for (const Building& house : plan_houses(1)) {
    if (!house.is_on_square) continue;
    ++on_square;
    const glm::vec2 middle(house.frame.point(0.5f * house.width_m, 0, 0));
    EXPECT_LT(glm::dot(-glm::vec2(house.frame.inward), middle), 0.0f);
    EXPECT_EQ(house.style.ground, GroundFloor::arcade);
  }
  EXPECT_GE(on_square, 10);
}

/// A window's reveal, an arch and a cornice are relief: the facade reaches in front of the wall and behind
/// it.
TEST(Square, FacadesAreRelief) {
  FacadeStyle style;
  style.ground = GroundFloor::arcade, style.ground_m = 5.9f, style.balconies = 1.0f;
  ReliefMesh mesh;
  mesh.begin_group("facade", {});
  Random random(1);
  add_facade(mesh, style, 12.6f, 3, true, true, random);
  scene::Model model;
  model.materials.resize(std::size_t(Surface::count));
  mesh.move_into(model);
  const Bounds bounds = scene::bounds(model);
  EXPECT_LT(bounds.min.y, -0.9f);  // balconies
  EXPECT_GT(bounds.max.y, gallery_m - 0.01f);
  EXPECT_NEAR(bounds.max.z, style.eaves_m(), 0.02f);
  for (const scene::Part& part : model.parts) {
    EXPECT_TRUE(check(part.mesh, part.object));
    // Triangles agree with their normals.
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      const auto p = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
      const glm::vec3 across = glm::cross(p(1) - p(0), p(2) - p(0));
      if (glm::length(across) < 1e-6f) continue;
      EXPECT_GT(glm::dot(across, part.mesh.normals[part.mesh.indices[i]]), 0.0f) << part.object;
    }
  }
}

TEST(Square, GroundLooksUpAndKerbsAreLow) {
  ReliefMesh mesh;
  add_square_ground(mesh);
  scene::Model model;
  model.materials.resize(std::size_t(Surface::count));
  mesh.move_into(model);
  for (const scene::Part& part : model.parts) {
    if (part.material == int(Surface::iron)) continue;
    EXPECT_LT(part.mesh.bounds().max.z, kerb_m + 0.01f);
    if (part.material == int(Surface::ashlar)) continue;
    for (const glm::vec3& normal : part.mesh.normals) EXPECT_GT(normal.z, 0.99f);
  }
}

TEST(Square, TheStatueStandsOnItsPedestalInTheBasin) {
  const scene::Model fountain = make_fountain();
  Bounds statue;
  for (const scene::Part& part : fountain.parts) {
    EXPECT_TRUE(check(part.mesh, part.object)) << part.object;
    if (part.object == "statue") statue.add(part.mesh.bounds());
  }
  EXPECT_NEAR(statue.min.z, 5.6f, 0.1f);
  EXPECT_GT(statue.max.z - statue.min.z, 3.2f);
}

}  // namespace
}  // namespace parvis::square
