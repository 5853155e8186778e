#include "places/dressing/terrain_plane.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/data/scene.h"
#include "scene/data/test_scene.h"

namespace parvis::dressing {
namespace {

/// A square of ground with sides of 200 m, turned by one degree, and a house on it.
scene::Scene village(float hill_m) {
  auto model = std::make_shared<scene::Model>();
  model->materials.emplace_back();
  const auto add = [&](const char* name, Mesh mesh) {
    scene::Part part;
    part.object = name, part.mesh = std::move(mesh);
    model->parts.push_back(std::move(part));
  };
  Mesh ground;
  constexpr std::uint32_t side = 40;
  for (std::uint32_t y = 0; y <= side; ++y)
    for (std::uint32_t x = 0; x <= side; ++x) {
      const glm::vec2 p = 200.0f * (glm::vec2(x, y) / float(side) - 0.5f);
      ground.positions.emplace_back(p.x - 0.0175f * p.y, p.y + 0.0175f * p.x, hill_m * std::sin(0.1f * p.x));
    }
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t a = y * (side + 1) + x, b = a + side + 1;
      ground.indices.insert(ground.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  add("TINRelief", std::move(ground));
  Mesh wall;
  wall.positions = {{-5, 95, 0}, {5, 95, 0}, {5, 95, 6}, {-5, 95, 6}}, wall.indices = {0, 1, 2, 0, 2, 3};
  add("WallSurface", std::move(wall));
  scene::Scene scene;
  scene.objects.emplace_back();
  scene.objects.back().model = model;
  return scene;
}

struct Extent {
  double area_m2 = 0.0, plan_m2 = 0.0;  ///< of what lies higher than 0.1 m below 0; of all, from above
  float lowest_m = 1e9f, highest_m = -1e9f;
  std::size_t triangles = 0;
};

Extent extent_of(const scene::Model& model) {
  Extent extent;
  for (const scene::Part& part : model.parts) {
    extent.triangles += part.mesh.triangle_count();
    for (std::size_t i = 0; i < part.mesh.indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
      const double plan_m2 = 0.5 * double(glm::cross(corner(1) - corner(0), corner(2) - corner(0)).z);
      if (corner(0).z > -0.1f) extent.area_m2 += plan_m2;
      extent.plan_m2 += plan_m2;
    }
    for (const glm::vec3& p : part.mesh.positions)
      extent.lowest_m = std::min(extent.lowest_m, p.z), extent.highest_m = std::max(extent.highest_m, p.z);
  }
  return extent;
}

TEST(TerrainPlane, TakesFewTrianglesAroundLevelGroundAndHasNoStepThere) {
  constexpr float margin_m = 80.0f;
  const scene::PlaceHeights place(village(0.0f), {}, margin_m);
  const scene::Model terrain = near_terrain(place, {});
  const scene::HeightRaster& heights = place.heights();
  const Extent extent = extent_of(terrain);
  EXPECT_LT(extent.triangles, 600u);
  EXPECT_NEAR(extent.lowest_m, -0.4f, 1e-3f) << "below cracks of the own ground";
  EXPECT_LE(extent.highest_m, 0.0f);
  for (const scene::Part& part : terrain.parts)
    for (const glm::vec3& p : part.mesh.positions) {
      const glm::ivec2 cell = heights.cell_at(glm::vec2(p));
      const bool is_inside = place.own_ground().at(cell.x, cell.y) != 0;
      EXPECT_TRUE(is_inside || p.z > -0.011f) << "a step of 1 cm is not to be seen";
    }
  const double all_m2 =
      double(heights.width - 1) * double(heights.height - 1) * double(heights.cell_m * heights.cell_m);
  EXPECT_GT(extent.area_m2, all_m2 - 200.0 * 200.0) << "no gap beside the place's own ground";
  EXPECT_LT(extent.area_m2, all_m2 - 190.0 * 190.0) << "and none of it twice";
  ASSERT_EQ(terrain.parts.size(), 2u) << "paving around the house, and lawn";
}

TEST(TerrainPlane, LeavesNoLawnsAsBlotsBetweenHouses) {
  scene::Scene scene;
  auto model = std::make_shared<scene::Model>();
  model->materials.emplace_back();
  for (float x = 0.0f; x < 200.0f; x += 50.0f)
    for (float y = 0.0f; y < 200.0f; y += 50.0f) {
      scene::Part part;
      part.object = "WallSurface", part.mesh = scene::box({x, y, 0}, {x + 14, y + 14, 6});
      model->parts.push_back(std::move(part));
    }
  scene.objects.emplace_back();
  scene.objects.back().model = model;
  const scene::PlaceHeights place(scene, {}, 60.0f);
  const scene::Model terrain = near_terrain(place, {"paving", "lawn", 500.0f});
  for (const scene::Part& part : terrain.parts)
    for (const glm::vec3& p : part.mesh.positions)
      if (part.object == "TINRelief beyond") {
        EXPECT_FALSE(p.x > 5.0f && p.x < 159.0f && p.y > 5.0f && p.y < 159.0f) << p.x << " " << p.y;
      }
}

TEST(TerrainPlane, GoesOnBelowUnevenGround) {
  const Extent extent = extent_of(near_terrain(scene::PlaceHeights(village(2.0f), {}, 80.0f), {}));
  EXPECT_LT(extent.lowest_m, -2.0f - 0.2f);
}

TEST(TerrainPlane, LiesBelowCracksWhereTheGroundHasHighSteps) {
  scene::Scene terraces = village(0.0f);
  auto model = std::make_shared<scene::Model>(*terraces.objects[0].model);
  Mesh& ground = model->parts[0].mesh;
  ground = {};
  for (const glm::vec3 low : {glm::vec3(-100, -100, 0), glm::vec3(0.05f, -100, 4)}) {
    const auto first = std::uint32_t(ground.positions.size());
    for (const glm::vec2 corner :
         {glm::vec2(0, 0), glm::vec2(100, 0), glm::vec2(100, 200), glm::vec2(0, 200)})
      ground.positions.push_back(low + glm::vec3(corner, 0.0f));
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) ground.indices.push_back(first + corner);
  }
  terraces.objects[0].model = model;
  const scene::PlaceHeights place(terraces, {}, 80.0f);
  const scene::HeightRaster& heights = place.heights();
  const double all_m2 =
      double(heights.width - 1) * double(heights.height - 1) * double(heights.cell_m * heights.cell_m);
  EXPECT_NEAR(extent_of(near_terrain(place, {})).plan_m2, all_m2, 1e-4 * all_m2);
}

}  // namespace
}  // namespace parvis::dressing
