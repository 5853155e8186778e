#include "land/heights/open_rooms.h"

#include <gtest/gtest.h>

#include "scene/data/surroundings.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

std::size_t add_part(Scene& scene, Mesh mesh, const char* name) {
  auto model = model_of(std::move(mesh), matt(glm::vec3(0.5f)));
  model->parts.front().object = name;
  return std::size_t(add(scene, model));
}

Mesh floor_at(float z, float side_m = 4.0f) {
  return quad({0, 0, z}, {side_m, 0, z}, {side_m, 4, z}, {0, 4, z});
}

/// Area in plan of land with sides of 40 m after rooms with floors, and ceilings, at these heights have been
/// opened.
double land_m2(const std::vector<float>& floors, const char* land = "TINRelief",
               const std::vector<float>& ceilings = {}, const char* floor = "FloorSurface") {
  Scene scene;
  const std::size_t object = add_part(scene, ground(20.0f), land);
  for (const float z : floors) add_part(scene, floor_at(z), floor);
  for (const float z : ceilings) add_part(scene, floor_at(z), "CeilingSurface");
  open_rooms(scene);
  const Model& model = *scene.objects[object].model;
  EXPECT_TRUE(check(model.parts.front().mesh, "land").ok());
  return area_m2(model, land);
}

TEST(OpenRooms, LandIsLeftOutWhereItWouldRiseThroughAFloor) {
  for (const char* land : {"TINRelief", "TINRelief near", "LandUse"})
    EXPECT_NEAR(land_m2({-0.2f}, land), 1600.0 - 16.0, 0.01) << land;
  EXPECT_NEAR(land_m2({0.01f}), 1600.0 - 16.0, 0.01) << "it would flicker through the floor";
  EXPECT_NEAR(land_m2({-2.5f, 0.3f, 3.3f}), 1600.0 - 16.0, 0.01) << "a cellar, counted once";
}

TEST(OpenRooms, LandBelowFloorsAndFarAboveThemStays) {
  EXPECT_NEAR(land_m2({0.2f, 3.0f}), 1600.0, 1e-3) << "a floor above the ground";
  EXPECT_NEAR(land_m2({-12.0f}), 1600.0, 1e-3) << "the ground over an underground hall";
  EXPECT_NEAR(land_m2({-0.2f}, "Road"), 1600.0, 1e-3) << "roads are drawn, not filled in";
}

TEST(OpenRooms, LandAboveTheCeilingOfACellarStays) {
  EXPECT_NEAR(land_m2({-2.6f}, "TINRelief", {-0.3f}), 1600.0, 1e-3) << "a courtyard over a garage";
  EXPECT_NEAR(land_m2({-2.6f}, "TINRelief", {0.3f}), 1600.0 - 16.0, 0.01) << "half above the ground";
  EXPECT_NEAR(land_m2({-2.6f, -0.1f}, "TINRelief", {-0.3f, 2.8f}), 1600.0 - 16.0, 0.01)
      << "with a room of the ground floor above it";
}

TEST(OpenRooms, SlabsOfCellarsAreFloors) {
  EXPECT_NEAR(land_m2({-2.6f}, "TINRelief", {}, "IfcSlab Concrete below ground"), 1600.0 - 16.0, 0.01);
  EXPECT_NEAR(land_m2({-0.2f}, "TINRelief", {}, "IfcSlab Concrete"), 1600.0, 1e-3)
      << "it covers the land itself";
}

TEST(OpenRooms, OnSlopingLandOnlyTheRoomsInTheHillAreOpened) {
  Scene scene;
  const std::size_t hill =
      add_part(scene, quad({-20, -20, -4}, {20, -20, 4}, {20, 20, 4}, {-20, 20, -4}), "TINRelief");
  add_part(scene, floor_at(0.2f), "FloorSurface");  // the land there lies at 0 to 0.8 m
  Mesh far = floor_at(0.2f);
  for (glm::vec3& point : far.positions) point.x -= 10.0f;
  add_part(scene, far, "FloorSurface");  // at -2 to -1.2 m
  open_rooms(scene);
  const Mesh& mesh = scene.objects[hill].model->parts.front().mesh;
  double plan_m2 = 0.0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
    plan_m2 += 0.5 * double(glm::cross(at(1) - at(0), at(2) - at(0)).z);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(at(k).z, 0.2f * at(k).x, 1e-4f);
  }
  EXPECT_NEAR(plan_m2, 1600.0 - 16.0, 0.01);
}

TEST(OpenRooms, PlacesWithoutRoomsAndTheLandAroundKeepTheirModels) {
  Scene scene;
  const std::size_t land = add_part(scene, ground(20.0f), "TINRelief"),
                    around = add_part(scene, ground(200.0f), "TINRelief around");
  const auto land_before = scene.objects[land].model, around_before = scene.objects[around].model;
  scene.data<ItemsOf<Surroundings>>().add({around_before}, 0);
  open_rooms(scene);
  EXPECT_EQ(scene.objects[land].model, land_before);
  const std::size_t floor = add_part(scene, floor_at(-0.2f), "FloorSurface");
  scene.objects[floor].is_visible = false;
  open_rooms(scene);
  EXPECT_EQ(scene.objects[land].model, land_before) << "hidden";
  scene.objects[floor].is_visible = true;
  open_rooms(scene);
  EXPECT_NE(scene.objects[land].model, land_before);
  EXPECT_EQ(scene.objects[around].model, around_before);
}

}  // namespace
}  // namespace parvis::scene
