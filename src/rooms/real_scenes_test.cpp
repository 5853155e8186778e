// The scenes of real cities, driven for five minutes: nobody runs into a house.
#include <gtest/gtest.h>

#include <cmath>

#include "base/test_data.h"
#include "land/heights/ground_raster.h"
#include "life/traffic/traffic.h"
#include "rooms/rooms.h"
#include "scene/script/scene_loader.h"
#include "stage/stage.h"

namespace parvis::rooms {
namespace {

constexpr float near_m = 12.0f;  // of lanes, in which houses matter

/// Cells that are built on: a roof lies over them.
scene::Mask built_on(const scene::Scene& scene) {
  Bounds bounds;
  for (const scene::Lane& lane : scene.roads.lanes)
    for (const glm::vec3& p : lane.points) bounds.add(p);
  const glm::vec2 size = glm::vec2(bounds.size()) + 2.0f * near_m;
  constexpr float cell_m = 0.25f;
  scene::Mask mask(int(size.x / cell_m), int(size.y / cell_m), cell_m, glm::vec2(bounds.min) - near_m, 0);
  for (const scene::Object& object : scene.objects) {
    const std::vector<glm::mat4> pose = scene::rest_pose(*object.model);
    for (const scene::Part& part : object.model->parts) {
      if (part.object != "RoofSurface") continue;
      const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
      for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
        std::vector<glm::vec3> ring;
        for (std::size_t k = 0; k < 3; ++k)
          ring.emplace_back(world_from_mesh * glm::vec4(part.mesh.positions[part.mesh.indices[i + k]], 1.0f));
        const std::vector<std::vector<glm::vec3>> rings{ring};
        for (const glm::ivec2 cell : scene::cells_inside(mask, rings)) mask.at(cell.x, cell.y) = 1;
      }
    }
  }
  return mask;
}

bool touches(const traffic::Footprint& footprint, const scene::Mask& mask) {
  const glm::vec2 left(-footprint.forward.y, footprint.forward.x);
  for (float along = -1.0f; along <= 1.0f; along += 0.1f)
    for (const float aside : {-1.0f, -0.5f, 0.0f, 0.5f, 1.0f}) {
      const glm::vec2 p = footprint.centre + along * footprint.half_length_m * footprint.forward +
                          aside * footprint.half_width_m * left;
      const glm::ivec2 cell = mask.cell_at(p);
      if (mask.contains(cell.x, cell.y) && mask.at(cell.x, cell.y)) return true;
    }
  return false;
}

void expect_orderly_traffic(const std::string& script, const std::string& city) {
  const auto file = shared_data(city);
  if (!file) GTEST_SKIP() << "skipped: shared data absent";
  const std::vector<std::filesystem::path> roots{file->parent_path().parent_path()};
  Result<scene::LoadedScene> loaded =
      scene::load_scene(source_folder() / "scenes" / script, node_registry(), roots);
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  const scene::Mask houses = built_on(loaded->scene);
  ASSERT_GT(std::ranges::count(houses.cells, 1), 1000);

  traffic::Traffic traffic(loaded->scene);
  const traffic::Simulation& simulation = traffic.simulation();
  ASSERT_GE(traffic.vehicle_count(), 9u);
  double travelled_m = 0.0;
  for (const traffic::Vehicle& vehicle : simulation.vehicles()) travelled_m -= vehicle.travelled_m;
  for (int tenth = 0; tenth < 3000; ++tenth) {
    for (int sixtieth = 0; sixtieth < 6; ++sixtieth) traffic.step();
    for (const traffic::Vehicle& vehicle : simulation.vehicles()) {
      const traffic::Footprint footprint = vehicle.footprint(0.0f, simulation.lanes());
      ASSERT_FALSE(touches(footprint, houses)) << "at " << footprint.centre.x << " " << footprint.centre.y;
    }
  }
  for (const traffic::Vehicle& vehicle : simulation.vehicles()) travelled_m += vehicle.travelled_m;
  EXPECT_GT(travelled_m / double(traffic.vehicle_count()), 300.0);
}

TEST(RealScenes, NobodyRunsIntoAHouseInTheHague) {
  expect_orderly_traffic("denhaag.xp", "cities/DenHaag_01.city.json");
}

TEST(RealScenes, NobodyRunsIntoAHouseInDelft) {
  expect_orderly_traffic("delft.xp", "cities/delft_context.city.json");
}

}  // namespace
}  // namespace parvis::rooms
