#include "places/dressing/town_ground.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/mesh.h"
#include "scene/data/test_scene.h"

namespace parvis::dressing {
namespace {

void add_ground_part(scene::Model& model, const char* name, Mesh mesh) {
  scene::Part part;
  part.object = name, part.mesh = std::move(mesh);
  part.mesh.uvs.resize(part.mesh.positions.size());
  model.parts.push_back(std::move(part));
}

/// Two triangles of land, 600 m by 400 m, with roofs of 10 m in rows: `gap_m` apart in the western half.
scene::Model town_with_gaps(float gap_m) {
  scene::Model model;
  model.materials.emplace_back();
  Mesh land;
  land.positions = {{0, 0, 0}, {600, 0, 0}, {600, 400, 0}, {0, 400, 0}}, land.indices = {0, 1, 2, 0, 2, 3};
  fill_normals(land);
  add_ground_part(model, "LandUse", land);
  for (float x = 60.0f; x < 300.0f; x += 10.0f + gap_m)
    for (float y = 60.0f; y < 340.0f; y += 10.0f + gap_m)
      add_ground_part(model, "RoofSurface", scene::box({x, y, 6}, {x + 10, y + 10, 7}));
  return model;
}

/// The area in plan, m2, of ground with a material of this name.
double ground_m2(const scene::Model& model, const std::string& material) {
  double area = 0.0;
  for (const scene::Part& part : model.parts)
    for (std::size_t i = 0; part.object == "LandUse" && i + 2 < part.mesh.indices.size(); i += 3) {
      if (model.materials[std::size_t(part.material)].name != material) continue;
      const auto at = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
      area += 0.5 * double(glm::cross(at(1) - at(0), at(2) - at(0)).z);
    }
  return area;
}

TEST(TownGround, IsPavedWhereHousesStandCloseAndLawnElsewhere) {
  scene::Model town = town_with_gaps(5.0f), village = town_with_gaps(16.0f);
  ASSERT_EQ(add_town_ground(town, "LandUse"), 1u);
  ASSERT_EQ(add_town_ground(village, "LandUse"), 1u);
  const double paved_m2 = ground_m2(town, "paving");
  EXPECT_NEAR(paved_m2 + ground_m2(town, "lawn"), 240'000.0, 10.0) << "no hole and nothing twice";
  EXPECT_NEAR(paved_m2, 240.0 * 280.0, 0.2 * 240.0 * 280.0);
  EXPECT_EQ(ground_m2(village, "paving"), 0.0);
  EXPECT_NEAR(ground_m2(village, "lawn"), 240'000.0, 10.0);
  std::size_t triangles = 0;
  for (const scene::Part& part : town.parts)
    if (part.object == "LandUse") triangles += part.mesh.triangle_count();
  EXPECT_LT(triangles, 5000u);
  for (const scene::Part& part : town.parts) EXPECT_TRUE(check(part.mesh, part.object).ok());
}

TEST(TownGround, EndsForEveryTriangle) {
  for (const float side_m : {1e30f, std::nanf("")}) {
    scene::Model model = town_with_gaps(5.0f);
    model.parts[0].mesh.positions[2].x = side_m;
    EXPECT_EQ(add_town_ground(model, "LandUse"), 1u);
  }
  scene::Model bare = town_with_gaps(5.0f);
  bare.parts.resize(1);
  EXPECT_EQ(add_town_ground(bare, "LandUse"), 1u);
  EXPECT_NEAR(ground_m2(bare, "lawn"), 240'000.0, 10.0);
  EXPECT_EQ(add_town_ground(bare, "no such name"), 0u);
}

}  // namespace
}  // namespace parvis::dressing
