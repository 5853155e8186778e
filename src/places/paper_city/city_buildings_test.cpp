#include "places/paper_city/city_buildings.h"

#include <gtest/gtest.h>

#include "places/paper_city/ground.h"

namespace parvis::city {
namespace {

/// The static city without its textures.
scene::Model bare_city(std::uint64_t seed) {
  const StreetPlan plan = make_street_plan(seed);
  CityMesh mesh;
  add_buildings(mesh, plan, seed);
  add_ground(mesh, plan);
  scene::Model model;
  model.materials.resize(std::size_t(CityMaterial::count));
  mesh.move_into(model);
  return model;
}

TEST(CityBuildings, HaveThePapersCountForAnySeed) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const StreetPlan plan = make_street_plan(seed);
    CityMesh mesh;
    add_buildings(mesh, plan, seed);
    EXPECT_EQ(mesh.triangle_count(), building_triangles) << "seed " << seed;
    add_ground(mesh, plan);
    EXPECT_EQ(mesh.triangle_count(), building_triangles + ground_triangles) << "seed " << seed;
  }
}

TEST(CityBuildings, HaveEightRoadsOnOneSquareKilometre) {
  EXPECT_EQ(make_street_plan(1).roads.size(), 8u);
  const Bounds box = bounds(bare_city(1));
  EXPECT_NEAR(box.min.x, -500.0f, 1.0f);
  EXPECT_NEAR(box.max.x, 500.0f, 1.0f);
  EXPECT_NEAR(box.min.y, -500.0f, 1.0f);
  EXPECT_NEAR(box.max.y, 500.0f, 1.0f);
  EXPECT_FLOAT_EQ(box.min.z, 0.0f);
  EXPECT_LT(box.max.z, 40.0f);
}

TEST(CityBuildings, HaveNoBrokenTriangles) {
  for (const scene::Part& part : bare_city(3).parts) {
    const Status status = check(part.mesh, part.object);
    ASSERT_TRUE(status) << to_string(status.errors());
    const std::vector<glm::vec3>& p = part.mesh.positions;
    for (std::size_t i = 0; i < part.mesh.indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) { return p[part.mesh.indices[i + k]]; };
      const glm::vec3 twice_area = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
      EXPECT_GT(glm::length(twice_area), 1e-4f) << part.object;
      EXPECT_GT(glm::dot(glm::normalize(twice_area), part.mesh.normals[part.mesh.indices[i]]), 0.99f)
          << part.object;
    }
    for (const glm::vec2 uv : part.mesh.uvs) EXPECT_LT(glm::length(uv), 150.0f) << part.object;
  }
}

TEST(CityBuildings, TurnTheirFacadesToTheStreet) {
  const StreetPlan plan = make_street_plan(5);
  for (const Plot& plot : plan.plots) {
    const glm::vec2 outside(plot.frame.point(0.5f * plot.width_m, -1.0f, 0.0f));
    bool is_on_a_road = false;
    for (const Road& road : plan.roads) {
      const float across = (road.runs_north ? outside.x : outside.y) - road.offset_m;
      is_on_a_road |= std::abs(across) < road.profile.half_width_m();
    }
    EXPECT_TRUE(is_on_a_road);
  }
}

TEST(CityBuildings, AreTheSameForTheSameSeedOnly) {
  const scene::Model a = bare_city(7), b = bare_city(7), c = bare_city(8);
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (std::size_t i = 0; i < a.parts.size(); ++i)
    EXPECT_EQ(a.parts[i].mesh.positions, b.parts[i].mesh.positions);
  EXPECT_TRUE(a.parts.size() != c.parts.size() || a.parts[0].mesh.positions != c.parts[0].mesh.positions);
}

}  // namespace
}  // namespace parvis::city
